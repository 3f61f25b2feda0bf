// A batch draws several members together. A member is one draw of a stage in one instance of its
// shape.

import type { BufferGeometry, Frustum, Material, Sphere } from "three";
import type { DrawRange, Stage } from "../../stage/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import { isSurface } from "../primitives/primitives.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { ShapeGroup } from "../shapes/shapeGroup.ts";
import type { MaterialRequest } from "../materials/materialFactory.ts";
import type { SurfaceTextures } from "../materials/surfaceTextures.ts";
import type { MemberTable } from "./memberTable.ts";
import { backFaces, frontFaces } from "../shaders/instanceRecord.ts";

/** A draw that a batch may take in; the same for all instances of its shape. */
export interface BatchedDraw {
  readonly stage: Stage;
  /** All ranges have the same primitive. A draw that is not merged has one range. */
  readonly ranges: readonly DrawRange[];
  readonly isMerged: boolean;
  /** Whether it blends, and is drawn in depth order, the farthest first. */
  readonly isBlended: boolean;
  /** Number of vertices of the stage; used if the draw is merged. */
  readonly vertexCount: number;
  /** Bounds of the vertices, in stored coordinates. */
  readonly bounds: Sphere;
  /** The point of stored coordinates 0, and the lattice step, in the shape's coordinates. */
  readonly origin: readonly [number, number, number];
  readonly step: readonly [number, number, number];
  readonly texCoordFrames: readonly number[];
  /** As valueFrameOf returns it; undefined without values. */
  readonly valueFrame: { readonly min: readonly number[]; readonly step: readonly number[] } | undefined;
  readonly request: MaterialRequest;
  readonly appearance: AppearanceDescription;
  readonly surfaceTextures: SurfaceTextures;
  /** As materialKeyOf returns it; draws with equal keys can use one material. */
  readonly materialKey: string;
}

/** A group with the members that are drawn in its place. */
export interface BatchedGroup extends ShapeGroup {
  members?: Member[] | undefined;
}

export interface Member {
  readonly draw: BatchedDraw;
  readonly group: BatchedGroup;
  /** Index of its record in the instance table. */
  readonly instanceIndex: number;
  batch: Batch | undefined;
  isVisible: boolean;
  /** Whether its transform mirrors, which swaps front and back faces. */
  isMirrored: boolean;
}

/** Consecutive members of a batch, drawn with one call. */
export interface Run {
  readonly members: readonly Member[];
  /** Render order among all runs of the frame. */
  readonly order: number;
}

/** What a batch is made from. */
export interface BatchResources {
  /** The draw of its first member. */
  readonly draw: BatchedDraw;
  readonly material: Material;
  /** Makes an object for a geometry with the material and adds it to the batches' root. */
  readonly addObject: (geometry: BufferGeometry) => DrawnObject;
  /** Has the bounds of the members. */
  readonly members: MemberTable;
}

export interface Batch {
  readonly isEmpty: boolean;
  hasRoomFor(member: Member): boolean;
  add(member: Member): void;
  remove(member: Member): void;
  /** Called when a member has moved or its visibility has changed. */
  invalidateBounds(): void;
  /** Called before a frame, for opaque batches: hides members outside the frustum, as far as that is cheap. */
  update(frustum: Frustum): void;
  /** Called before a frame, for transparent batches: the frame draws these runs of the batch and no other members. */
  drawRuns(runs: readonly Run[]): void;
  dispose(): void;
}

/** The geometry into which members are merged. */
export interface MergedGeometry {
  readonly members: Iterable<Member>;
  readonly isEmpty: boolean;
  /** Whether removed members waste much memory, or would still be visible. */
  readonly needsRebuild: boolean;
  hasRoomFor(member: Member): boolean;
  add(member: Member): void;
  remove(member: Member): void;
  /** Rewrites the geometry without removed members. */
  rebuild(): void;
  /** Makes a geometry that shares memory with this object, and is valid until the next `add`. */
  makeGeometry(): BufferGeometry;
}

/**
 * The passes of a draw, as numbers to add to the instance index. Blended surfaces with two sides are drawn twice, back
 * faces first, as three.js draws such objects.
 */
export function passesOf({ isBlended, request: { solid, primitive } }: BatchedDraw): readonly number[] {
  return isBlended && !solid && isSurface({ primitive }) ? [backFaces, frontFaces] : [0];
}
