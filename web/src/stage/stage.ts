// A stage: what one patch can show now. Every container ends here, and the
// renderer knows nothing of how a stage came about; it only ever replaces a
// patch's stage by a newer one.

import type { Bounds, VertexArray } from "./vertexArray.ts";
import type { ElementType } from "./elementType.ts";
import type { DecodedImage } from "./decodedImage.ts";

/** Running numbers first .. first + count - 1 drawn as one kind of primitive. */
export interface DrawRange {
  readonly primitive: "points" | "lines" | "lineStrip" | "triangles" | "triangleStrip";
  readonly first: number;
  readonly count: number;
  /** Lines that are drawn as surfaces of a width on the screen. */
  readonly isWide?: boolean;
}

/**
 * How far a patch is, as events name it: vertices alone, a coarse shape that stands
 * in for it, a surface shaded by its own slope, one shaded by its normals, and all
 * there is.
 */
export type StageName = "points" | "base" | "surface" | "shaded" | "full";
export const stageNames: readonly StageName[] = ["points", "base", "surface", "shaded", "full"];

interface StageHead {
  readonly name: StageName;
  readonly draws: readonly DrawRange[];
}

/** Texels of an image from the number `first` on, row by row. */
export interface TexelRange {
  readonly image: DecodedImage;
  readonly firstTexel: number;
}

/** Two numbers for a normal, octahedral x and y or spherical phi and theta, of so many bits. */
export interface PairCode {
  readonly kind: "octahedral" | "spherical";
  readonly bits: 8 | 16;
}

/** What a stored normal is: a vector; one whose components are bytes, 0 … 255 for -1 … 1; or two numbers. */
export type NormalCode = { readonly kind: "vector" | "byteVector" } | PairCode;

export function isPairCode(code: NormalCode): code is PairCode {
  return "bits" in code;
}

/**
 * A surface over a grid of texels, without an index: heights over a plane, points
 * of a sheet, or points of a sheet whose last column is joined to its first.
 */
export interface Grid {
  readonly kind: "heightMap" | "geometryImage" | "sculpt";
  /** Of vertices, each 2 or more. */
  readonly columns: number;
  readonly rows: number;
}

/** Vertices that the shader fetches from images (classic SIG). */
export interface TextureStage extends StageHead {
  readonly kind: "textures";
  /** Absent: running numbers are record numbers. */
  readonly index: TexelRange | undefined;
  /** Index texels hold the record's number; otherwise its column and row. */
  readonly isIndexWide: boolean;
  /** Its two triangles a cell are what is drawn, and without normals it is shaded by those of its slope. */
  readonly grid: Grid | undefined;
  /** Running number n is texel (n mod implicitWidth, n div implicitWidth). */
  readonly implicitWidth: number;
  /** The byte planes that are here, most significant first. */
  readonly coord: readonly TexelRange[];
  /** The byte planes that there will be. */
  readonly coordPlaneCount: number;
  /** Added to every coordinate in place of the bytes that are not here. */
  readonly missingBytesMidpoint: number;
  readonly normal: TexelRange | undefined;
  readonly normalCode: NormalCode;
  readonly color: TexelRange | undefined;
  readonly colorComponents: 3 | 4;
  readonly texCoord: TexelRange | undefined;
  /** Of the attribute that colours the geometry, its first byte planes; undefined until there are any. */
  readonly value: ValuePlanes | undefined;
}

/** Numbers in byte planes, most significant first. */
export interface ValuePlanes {
  /** Those that are here. */
  readonly planes: readonly TexelRange[];
  readonly planeCount: number;
  /** Added to every stored number in place of the bytes that are not here. */
  readonly missingBytesMidpoint: number;
}

/** Bytes of typed arrays that are where draws read them, and not here any more. */
export interface StoredBytes {
  readonly byteLength: number;
  /** Gives their memory back. */
  close(): void;
}

/** WebGL wants to know before: a buffer that has held the one never holds the other. */
export type ArrayUse = "vertices" | "index";

/** A VertexArray that is stored. */
export interface StoredVertices extends Omit<VertexArray, "array"> {
  readonly bytes: StoredBytes;
  readonly type: ElementType;
}

/** Of the attribute that colours a geometry. */
export interface StoredValues extends StoredVertices {
  /** The stored integer that stands for the far side of the attribute's box, as 0 for its near side; undefined: numbers as they are. */
  readonly maxStored: number | undefined;
}

export interface StoredIndex {
  readonly bytes: StoredBytes;
  readonly type: ElementType;
}

/** Vertices in buffers (BG). Coordinates are integers as stored, the rest is spread over its range. */
export interface BufferStage extends StageHead {
  readonly kind: "buffers";
  /** Records of the patch in `coord`, whose file may hold more; 0: unknown. */
  readonly vertexCount: number;
  readonly index: StoredIndex | undefined;
  readonly coord: StoredVertices;
  /** Around the coordinates, where the document does not tell. */
  readonly bounds?: Bounds | undefined;
  /** Of two numbers of 8 bits also one 16-bit word, the first number its low byte. */
  readonly normal: StoredVertices | undefined;
  readonly normalCode: NormalCode;
  readonly color: StoredVertices | undefined;
  readonly value: StoredValues | undefined;
  readonly texCoord: StoredVertices | undefined;
}

export type Stage = TextureStage | BufferStage;
