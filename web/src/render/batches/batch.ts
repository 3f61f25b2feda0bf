// What is drawn together: members, each of which is a draw of a stage in one place.

import type { Frustum, Group, Matrix4, Sphere } from "three";
import type { DrawRange, Stage } from "../../decode/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import type { DrawnObject } from "../drawnObject.ts";
import type { MaterialRequest, ShownPictures } from "../look.ts";

/** What a shape asks to be drawn of a stage. The same for all its places. */
export interface BatchedDraw {
  readonly stage: Stage;
  /** Of one kind of primitive; only one, unless it is to be merged. */
  readonly ranges: readonly DrawRange[];
  readonly isMerged: boolean;
  /** Of the stage; of use where it is merged. */
  readonly vertexCount: number;
  /** Around the stored vertices. */
  readonly bounds: Sphere;
  readonly shapeFromStored: Matrix4;
  /** Of the lattice, in the shape's coordinates. */
  readonly step: readonly [number, number, number];
  readonly texCoordFrame: readonly [number, number, number, number];
  readonly request: MaterialRequest;
  readonly appearance: AppearanceDescription;
  readonly pictures: ShownPictures;
  /** The same where one material will do. */
  readonly lookKey: string;
}

export interface Member {
  readonly draw: BatchedDraw;
  readonly group: Group;
  /** Its record in the table of places. */
  readonly place: number;
  batch: Batch | undefined;
  isShown: boolean;
  /** Its place turns triangles inside out. */
  isMirrored: boolean;
  /** Around it, in the coordinates of what the batches hang in. */
  readonly sphere: Sphere;
}

export interface Batch {
  readonly object: DrawnObject;
  readonly isEmpty: boolean;
  hasRoomFor(member: Member): boolean;
  add(member: Member): void;
  remove(member: Member): void;
  /** A member's place has changed, or whether it is shown. */
  touch(): void;
  /** Before a frame: what of it a camera sees is drawn, as far as that is cheap to tell. */
  update(frustum: Frustum): void;
  dispose(): void;
}
