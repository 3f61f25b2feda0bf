// The entry for three.js apps. Importing it defines no element and does not change the page.

export type { LoadOptions } from "./ImgeoLoader.ts";
export { ImgeoLoader } from "./ImgeoLoader.ts";
export type { ImgeoScene, ImgeoSceneEventMap } from "./imgeoScene.ts";
export type { SceneHit } from "./scenePicking.ts";
export type { MaterialMaker } from "./standardMaterials.ts";
export { standardMaterialOf } from "./standardMaterials.ts";
export type { MaterialDescription, SceneDescription } from "../document/description.ts";
export type { Progress, Transfer } from "../delivery/progress.ts";
export type { Shading } from "../render/materials/materialFactory.ts";
