import { load } from "./gltf.ts";
import { show } from "./stage.ts";

show(await load("mesh.glb"));
