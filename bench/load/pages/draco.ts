// Displays a mesh that three.js' DRACOLoader decodes.

import { Mesh, MeshPhongMaterial } from "three";
import { DRACOLoader } from "three/examples/jsm/loaders/DRACOLoader.js";
import { show } from "./threePage.ts";

const loader = new DRACOLoader().setDecoderPath("draco/");
const geometry = await loader.preload().loadAsync("mesh.drc");
show(new Mesh(geometry, new MeshPhongMaterial()));
