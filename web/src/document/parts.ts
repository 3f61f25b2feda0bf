// The parts of the runtime that are modules of their own, because few scenes need them. The scene reader says which a
// scene needs; viewer/parts loads them.

import type { SceneElement } from "./element.ts";

/**
 * `documentGeometry`: geometry whose numbers are in the document, and text. `files`: geometry in images of classic and
 * in arrays of BG, and lines with a width or dashes. `streams`: live streams, and sequences of frames. `extensions`:
 * materials with extensions. `levels`: meshes with levels of detail. `batches`: pages draw many instances together.
 * `operators`: geometry nodes with operators. `environment`: what is around shapes or changes how they look
 * (scene/environmentIn.ts). `walking`: the navigation type WALK.
 * `deformation`: shapes whose vertices joints and displacers move. `values`: shapes whose vertices have values that
 * colour them or are depths in fog.
 */
export type PartName =
  | "documentGeometry"
  | "files"
  | "streams"
  | "extensions"
  | "levels"
  | "batches"
  | "operators"
  | "environment"
  | "walking"
  | "deformation"
  | "values";

/** Pages draw a scene in batches if it has at least so many instances of shapes. */
export const minBatchedInstances = 16;

/** Called wherever a node needs a part. `unread`: the node, if it is to be read again when the part is there. */
export type NeedPart = (part: PartName, unread?: SceneElement) => void;
