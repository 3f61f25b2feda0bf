// What is drawn together: members, each of which is a draw of a stage in one place.

import type { BufferGeometry, Frustum, Material, Matrix4, Sphere } from "three";
import type { DrawRange, Stage } from "../../stage/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import { isSurface } from "../primitives/primitives.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { ShapeGroup } from "../lights/lightScopes.ts";
import type { MaterialRequest } from "../materials/materialFactory.ts";
import type { SurfaceTextures } from "../materials/surfaceTextures.ts";
import { backFaces, frontFaces } from "../shaders/instanceRecord.ts";

/** What a shape asks to be drawn of a stage. The same for all its places. */
export interface BatchedDraw {
  readonly stage: Stage;
  /** Of one kind of primitive; only one, unless it is to be merged. */
  readonly ranges: readonly DrawRange[];
  readonly isMerged: boolean;
  /** Drawn in its turn, the farthest first. */
  readonly isBlended: boolean;
  /** Of the stage; of use where it is merged. */
  readonly vertexCount: number;
  /** Around the stored vertices. */
  readonly bounds: Sphere;
  readonly shapeFromStored: Matrix4;
  /** Of the lattice, in the shape's coordinates. */
  readonly step: readonly [number, number, number];
  readonly texCoordFrame: readonly [number, number, number, number];
  /** As valueFrameOf says it. */
  readonly valueFrame: { readonly min: readonly number[]; readonly step: readonly number[] };
  readonly request: MaterialRequest;
  readonly appearance: AppearanceDescription;
  readonly surfaceTextures: SurfaceTextures;
  /** The same where one material will do. */
  readonly materialKey: string;
}

export interface Member {
  readonly draw: BatchedDraw;
  readonly group: ShapeGroup;
  /** Its record in the table of places. */
  readonly instanceIndex: number;
  batch: Batch | undefined;
  isVisible: boolean;
  /** Its place turns triangles inside out. */
  isMirrored: boolean;
  /** Around it, in the coordinates of what the batches hang in. */
  readonly sphere: Sphere;
}

/** Members of a batch that one call draws, one after the other. */
export interface Run {
  readonly members: readonly Member[];
  /** Among all runs of a frame. */
  readonly order: number;
}

/** What a batch is made of. */
export interface BatchResources {
  /** The first of its members. */
  readonly draw: BatchedDraw;
  readonly material: Material;
  /** An object that draws a geometry with the material, where the batch hangs. */
  readonly addObject: (geometry: BufferGeometry) => DrawnObject;
}

export interface Batch {
  readonly isEmpty: boolean;
  hasRoomFor(member: Member): boolean;
  add(member: Member): void;
  remove(member: Member): void;
  /** A member's place has changed, or whether it is shown. */
  invalidateBounds(): void;
  /** Before a frame: what of it a camera sees is drawn, as far as that is cheap to tell. */
  update(frustum: Frustum): void;
  /** The same where it blends: these are drawn. */
  drawRuns(runs: readonly Run[]): void;
  dispose(): void;
}

/** What members have become one of. */
export interface MergedGeometry {
  readonly members: Iterable<Member>;
  readonly isEmpty: boolean;
  /** What members have left that are gone takes much room, or would be seen: it is to be written anew. */
  readonly needsRebuild: boolean;
  hasRoomFor(member: Member): boolean;
  add(member: Member): void;
  remove(member: Member): void;
  /** Without what has been removed. */
  rebuild(): void;
  /** Valid until there is more of it: they share memory. */
  makeGeometry(): BufferGeometry;
}

/**
 * What blends and has two sides is drawn twice, its back faces first, as three.js draws such objects:
 * by what is added to its place's number.
 */
export function passesOf({ isBlended, request: { solid, primitive } }: BatchedDraw): readonly number[] {
  return isBlended && !solid && isSurface({ primitive }) ? [backFaces, frontFaces] : [0];
}
