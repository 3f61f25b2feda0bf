// Displays a glTF file of gltfpack.

import { load } from "./gltf.ts";
import { show } from "./threePage.ts";

show(await load("mesh.glb"));
