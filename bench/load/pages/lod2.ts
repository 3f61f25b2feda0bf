// Displays a coarse model before the full one, as many three.js apps do for large models.

import { load } from "./gltf.ts";
import { show } from "./threePage.ts";

show(await load("coarse.glb"), false);
show(await load("mesh.glb"));
