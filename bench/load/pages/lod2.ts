// The few lines with which many make a large model appear sooner.

import { load } from "./gltf.ts";
import { show } from "./threePage.ts";

show(await load("coarse.glb"), false);
show(await load("mesh.glb"));
