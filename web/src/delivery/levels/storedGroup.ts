// A group of triangles or points of a level of detail on the GPU, and the stages that draw parts of it.

import type { LevelGroup } from "../../decode/compact/levelGroup.ts";
import type { PatchBuffers } from "../../decode/compact/patchBuffers.ts";
import { DecodeError } from "../../decode/decodeError.ts";
import type { GeometryDescription, PatchDescription, Vec3 } from "../../document/description.ts";
import { dequantizationOf } from "../../document/dequantization.ts";
import { drawRanges } from "../../levels/drawRanges.ts";
import { checkCounts } from "../../levels/groupCounts.ts";
import type { LevelIndex } from "../../levels/levelIndex.ts";
import { texCoordRoles } from "../../stage/attributeRows.ts";
import type { BufferStage, DrawRange, StageImage, StageName } from "../../stage/stage.ts";
import type { StoreBytes } from "../arrayUploads.ts";
import { ArrayUploads } from "../arrayUploads.ts";
import { checkBits, retireBuffers, storeBuffers } from "../encodings/compact/compactStage.ts";

export class StoredGroup {
  /** GPU memory, without that of its image. */
  readonly byteLength: number;
  readonly #uploads: ArrayUploads;
  readonly #whole: BufferStage;
  readonly #segmentStarts: Int32Array;

  private constructor(uploads: ArrayUploads, whole: BufferStage, segmentStarts: Int32Array) {
    this.byteLength = uploads.byteLength;
    this.#uploads = uploads;
    this.#whole = whole;
    this.#segmentStarts = segmentStarts;
  }

  /**
   * Uploads a group. `chips`: its image, on the GPU, which the caller keeps until the group has been closed. Rejects
   * with the signal's reason; nothing then remains allocated.
   */
  static async store(
    { buffers, segmentStarts }: LevelGroup,
    geometry: GeometryDescription,
    storeBytes: StoreBytes,
    signal: AbortSignal,
    chips?: StageImage,
  ): Promise<StoredGroup> {
    const uploads = new ArrayUploads(storeBytes);
    const primitive = buffers.topology === "points" ? "points" : "triangles";
    const count = buffers.index?.length ?? buffers.vertexCount;
    const draws = [{ primitive, first: 0, count }] as const;
    const drawn = chips ? withoutSourceTexCoords(buffers) : buffers;
    const whole = await storeBuffers(uploads, drawn, geometry, "full", draws, signal);
    return new StoredGroup(uploads, { ...whole, chips }, segmentStarts);
  }

  /**
   * Draws the segments of those children that are not open; on level 0, without children, all elements.
   * `errorOf`: the stated error of a child, in lattice steps. `ownError`: that of the group, likewise.
   */
  stage(
    name: StageName,
    children: readonly number[],
    open: ReadonlySet<number>,
    errorOf: (child: number) => number,
    ownError: number,
  ): BufferStage {
    if (this.#whole.index === undefined)
      return { ...this.#whole, name, draws: this.#pointDraws(children, open, errorOf, ownError) };
    const draws = drawRanges(children, this.#segmentStarts, open).map(({ first, count }): DrawRange => {
      const drawn = children.filter((_, i) => {
        const start = this.#segmentStarts[i] ?? 0;
        return start >= first && start < first + count;
      });
      const error = drawn.length > 0 ? { error: Math.max(...drawn.map(errorOf)) } : {};
      return { primitive: "triangles", first: 3 * first, count: 3 * count, ...error };
    });
    return { ...this.#whole, name, draws };
  }

  /**
   * Segments are draws of their own: each has its spacing. On level 0, whose gaps are not stated, points are as wide as
   * those of their coarse form, which covers about twice their gaps.
   */
  #pointDraws(
    children: readonly number[],
    open: ReadonlySet<number>,
    errorOf: (child: number) => number,
    ownError: number,
  ): DrawRange[] {
    const starts = this.#segmentStarts;
    const primitive = "points";
    if (children.length === 0)
      return [{ primitive, first: 0, count: starts.at(-1) ?? 0, spacing: spacingOf(ownError) }];
    return children.flatMap((child, i): DrawRange[] => {
      if (open.has(child)) return [];
      const [first, error] = [starts[i] ?? 0, errorOf(child)];
      return [{ primitive, first, count: (starts[i + 1] ?? 0) - first, error, spacing: spacingOf(error) }];
    });
  }

  /** Frees the memory. No stage may be drawn any more. */
  close(): void {
    retireBuffers(this.#uploads, this.#whole);
    this.#uploads.sweep();
  }
}

/**
 * The diameter of points, relative to an error: 2 covers the points within the error, and more the surface between them
 * (docs/decisions/point-levels.md).
 */
const diameterPerError = 2.5;

/** The diameter of points that leave no gaps; 0 where no error is stated or its page is not here. */
function spacingOf(error: number): number {
  return Number.isFinite(error) ? diameterPerError * error : 0;
}

/** The texture coordinates in the image of the whole mesh, which nothing reads where groups have images. */
function withoutSourceTexCoords(buffers: PatchBuffers): PatchBuffers {
  return { ...buffers, attributes: { ...buffers.attributes, texCoord: undefined } };
}

/** Throws DecodeError where a decoded group is not as the index and the node state. */
export function checkGroup(decoded: LevelGroup, index: LevelIndex, group: number, geometry: GeometryDescription): void {
  checkBits(decoded.buffers, geometry);
  const { chips } = geometry.levels ?? {};
  const role = chips === undefined ? undefined : texCoordRoles[chips];
  if (role !== undefined && decoded.buffers.attributes[role] === undefined)
    throw new DecodeError("malformed", "lacks the texture coordinates of its image");
  checkCounts(decoded, index, group);
}

/** A group as a patch of its geometry: `whole` within the box of the group's sphere. */
export function groupPatch(
  geometry: GeometryDescription,
  whole: PatchDescription,
  index: LevelIndex,
  group: number,
): PatchDescription {
  const { origin, step } = dequantizationOf(geometry, whole);
  const sphere = { x: 0, y: 0, z: 0, radius: 0, reach: 0, error: 0 };
  index.readBounds(group, sphere);
  const center = [sphere.x, sphere.y, sphere.z] as const;
  const corner = (sign: number, limits: Vec3 | undefined, clamp: (a: number, b: number) => number): Vec3 => {
    const along = (axis: 0 | 1 | 2) => {
      const at = origin[axis] + (center[axis] + sign * sphere.radius) * step[axis];
      return limits === undefined ? at : clamp(at, limits[axis]);
    };
    return [along(0), along(1), along(2)];
  };
  const min = corner(-1, whole.box?.min, Math.max);
  const max = corner(1, whole.box?.max, Math.min);
  return {
    ...whole,
    box: [...min, ...max].every(Number.isFinite) ? { min, max } : whole.box,
    vertexCount: index.vertices(group),
    draws: [
      index.hasPoints
        ? { primitive: "points", count: index.vertices(group) }
        : { primitive: "triangles", count: 3 * index.triangles(group) },
    ],
  };
}
