// The geometry of a live stream: what the document states, completed by what the stream states.

import type { AttributeDescription, Draw, GeometryDescription, PatchDescription } from "../../document/description.ts";
import { byVertexRole } from "../../stage/attributeRows.ts";
import { rangeOf } from "../../document/attributes.ts";
import { isDrawnFromImages } from "../../document/drawnFromImages.ts";
import type { NormalSource } from "../../decode/frame/frameArrays.ts";
import { frameImageSizeOf } from "../../decode/frame/frameImages.ts";
import { imageEdgeOf } from "../encodings/classic/classicDelivery.ts";
import type { FrameDescription } from "../../decode/frame/frameDescription.ts";

/** What the GPU can read. */
export interface ImageReading {
  /** Whether shaders read images exactly. */
  readonly readsTextures: boolean;
  /** The longest edge of an image, in texels. */
  readonly maxTextureSize: number;
}

/**
 * The geometry with the lattice, the box, the vertices and the attributes of the stream. Where the document has no
 * index, a grid is a surface unless the document draws points; all other vertices are points. `decode` states where
 * vertices are read: "gpu" from images, "cpu" from buffers that workers fill.
 */
export function withStreamState(
  geometry: GeometryDescription,
  state: FrameDescription,
  reading: ImageReading,
): GeometryDescription {
  const { positionBits, origin, step, vertices, columns, box } = state;
  const [stated] = geometry.patches;
  if (stated === undefined) throw new RangeError("a stream has one patch");
  const planeCount = Math.ceil(positionBits / 8);
  // Coordinates are stored integers of whole bytes, whose largest value is the upper side of the box.
  const edge = step * (256 ** planeCount - 1);
  const rows = columns > 0 ? vertices / columns : 0;
  const areStatedPoints = stated.draws.some(({ primitive }) => primitive === "points");
  const hasGrid = stated.index === undefined && !areStatedPoints && columns > 1 && rows > 1;
  // Frames have three coordinates, so that heights over a plane are positions, too.
  const kind = stated.grid?.kind === "sculpt" ? "sculpt" : "geometryImage";
  const grid = hasGrid ? ({ kind, columns, rows } as const) : undefined;
  const coord = stated.coord[0];
  const planes = (count: number) => Array.from({ length: count }, () => coord).filter((plane) => plane !== undefined);
  // The values of a sequence may be those of the document.
  const isValueStatic = state.valueComponents === 0 && stated.value.length > 0;
  const value = isValueStatic ? geometry.value : geometry.value && withRange(geometry.value, state);
  const { normal: normalLowBytes, color: colorLowBytes, ...otherLowBytes } = stated.lowBytes;
  const streamed: Partial<PatchDescription> = {
    ...(state.normalBits > 0 && { normal: undefined }),
    ...(state.colorComponents > 0 && { color: undefined }),
    lowBytes: {
      ...otherLowBytes,
      ...(normalLowBytes && state.normalBits === 0 && { normal: normalLowBytes }),
      ...(colorLowBytes && state.colorComponents === 0 && { color: colorLowBytes }),
    },
  };
  const patch: PatchDescription = {
    ...stated,
    ...(stated.index === undefined && byVertexRole((role) => (role.startsWith("texCoord") ? stated[role] : undefined))),
    ...streamed,
    box,
    vertexCount: vertices,
    draws: stated.index === undefined ? drawsOf(grid, vertices) : stated.draws,
    implicitWidth: stated.index === undefined ? columns || Math.min(vertices, 1024) : stated.implicitWidth,
    grid,
    coord: planes(planeCount),
    value: isValueStatic ? stated.value : value === undefined ? [] : planes(Math.ceil(state.valueBits / 8)),
  };
  return {
    ...geometry,
    decode: isReadFromImages(geometry, patch, state, reading) ? "gpu" : "cpu",
    positionBits: 0,
    position: [origin[0] + edge / 2, origin[1] + edge / 2, origin[2] + edge / 2],
    size: [edge, edge, edge],
    colorComponents: state.colorComponents === 4 ? 4 : state.colorComponents === 3 ? 3 : geometry.colorComponents,
    value,
    patches: [patch],
  };
}

function isReadFromImages(
  geometry: GeometryDescription,
  patch: PatchDescription,
  state: FrameDescription,
  { readsTextures, maxTextureSize }: ImageReading,
): boolean {
  // Shaders know the neighbours of a vertex in a grid; those in an index, workers find.
  const needsTriangles = patch.index !== undefined && patch.normal === undefined && state.normalBits === 0;
  if (!isDrawnFromImages(geometry, patch) || (needsTriangles && patch.draws.every(isSurface))) return false;
  const { width, height } = frameImageSizeOf(state);
  const fits = Math.max(width, height, imageEdgeOf(patch)) <= maxTextureSize;
  return fits && (geometry.decode === "gpu" || readsTextures);
}

/** The normals of frames without stored ones, in a grid. */
export function gridNormalsOf(
  { ccw, patches: [patch] }: GeometryDescription,
  { normalBits }: FrameDescription,
): NormalSource | undefined {
  if (patch?.grid === undefined || patch.normal !== undefined || normalBits > 0) return undefined;
  return { kind: "grid", grid: patch.grid, ccw };
}

function isSurface({ primitive }: Draw): boolean {
  return primitive.startsWith("triangle");
}

function drawsOf(grid: PatchDescription["grid"], vertices: number): readonly Draw[] {
  if (grid === undefined) return [{ primitive: "points", count: vertices }];
  const cellsAcross = grid.kind === "sculpt" ? grid.columns : grid.columns - 1;
  return [{ primitive: "triangles", count: 6 * cellsAcross * (grid.rows - 1) }];
}

/** Undefined where the stream has no values. */
function withRange(value: AttributeDescription, state: FrameDescription): AttributeDescription | undefined {
  if (state.valueComponents === 0) return undefined;
  // Values fill their bits, images whole bytes.
  const stretch = (256 ** Math.ceil(state.valueBits / 8) - 1) / (2 ** state.valueBits - 1);
  const components = state.valueComponents as AttributeDescription["components"];
  const min = state.valueRange.map(([low]) => low);
  const size = state.valueRange.map(([low, high]) => high - low);
  return {
    ...value,
    components,
    bits: 8 * Math.ceil(state.valueBits / 8),
    min,
    size: size.map((extent) => extent * stretch),
    streamedRange: rangeOf({ components, min, size }),
  };
}
