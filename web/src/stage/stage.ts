// A stage: what one patch can draw now. Builders of every encoding make stages (delivery), and the renderer draws them
// without knowing the encoding: it replaces the previous stage of a patch by the next.

import type { ByVertexRole } from "./attributeRows.ts";
import type { Bounds, ElementArray, VertexArray } from "./vertexArray.ts";
import type { Deformation } from "./deformation.ts";
import type { ElementType } from "./elementType.ts";
import type { DecodedImage } from "./decodedImage.ts";

/**
 * Elements first .. first + count - 1 (indices, or vertices where there is no index) drawn as one kind of primitive.
 */
export interface DrawRange {
  readonly primitive: "points" | "lines" | "lineStrip" | "triangles" | "triangleStrip";
  readonly first: number;
  readonly count: number;
  /** Whether lines are drawn as surfaces, with a width in pixels. */
  readonly isWide?: boolean;
  /** Points: they are drawn at least so wide that those of this spacing leave no gaps, in stored units. */
  readonly spacing?: number;
  /** Coarse forms of levels of detail: how far the mesh may be from what is drawn, in stored units. */
  readonly error?: number;
}

/**
 * The stages of a patch, as events name them: vertices only; a base mesh that stands in for the patch; a surface shaded
 * by its slope; one shaded by its normals; and the complete patch.
 */
export type StageName = "points" | "base" | "surface" | "shaded" | "full";
export const stageNames: readonly StageName[] = ["points", "base", "surface", "shaded", "full"];

/** A draw as a document states it: it may be of a primitive that is converted before it is drawn. */
export interface StatedDrawRange extends Omit<DrawRange, "primitive"> {
  readonly primitive: DrawRange["primitive"] | "lineLoop" | "triangleFan";
}

interface StageHead {
  readonly name: StageName;
  readonly draws: readonly DrawRange[];
  /** Bounds of the coordinates, where the document states none. */
  readonly bounds?: Bounds | undefined;
}

/** Texels of an image from `firstTexel` on, row by row. */
export interface TexelRange {
  readonly image: DecodedImage;
  readonly firstTexel: number;
}

/** A normal as two numbers of `bits` bits: octahedral x and y, or spherical phi and theta. */
export interface PairNormalFormat {
  readonly kind: "octahedral" | "spherical";
  readonly bits: 8 | 16;
}

/** How normals are stored: as vectors, as vectors of bytes 0 … 255 for -1 … 1, or as two numbers. */
export type NormalFormat = { readonly kind: "vector" | "byteVector" } | PairNormalFormat;

export function isPairFormat(format: NormalFormat): format is PairNormalFormat {
  return "bits" in format;
}

/**
 * A surface over a grid of texels, without an index: heights over a plane; positions; or positions whose last column is
 * joined to the first.
 */
export interface Grid {
  readonly kind: "heightMap" | "geometryImage" | "sculpt";
  /** Number of vertices along each side, 2 or more. */
  readonly columns: number;
  readonly rows: number;
  /** Undefined: the grid is a whole height map, or no height map. */
  readonly part?: GridPart | undefined;
}

/** The part of a height map that a grid is: its first column and row, and how many the map has. */
export interface GridPart {
  readonly column: number;
  readonly row: number;
  readonly columns: number;
  readonly rows: number;
}

/** How the vertices of a stage in buffers lay in images of coordinates, from which they were decoded. */
export interface CoordImage {
  /** Vertices in a row. */
  readonly columns: number;
  readonly grid: Grid | undefined;
}

/** A stage whose vertices the shader fetches from images (SIG classic). */
export interface TextureStage extends StageHead {
  readonly kind: "textures";
  /** Undefined: element n is record n. */
  readonly index: TexelRange | undefined;
  /** Whether index texels hold the index of the record; otherwise its column and row in the coordinate image. */
  readonly isIndexWide: boolean;
  /** Draws two triangles for each cell; without normals it is shaded by its slope. */
  readonly grid: Grid | undefined;
  /** Element n is texel (n mod implicitWidth, n div implicitWidth). */
  readonly implicitWidth: number;
  /** The available byte planes, most significant first. */
  readonly coord: readonly TexelRange[];
  /** Number of byte planes of the complete patch. */
  readonly coordPlaneCount: number;
  /** Added to every coordinate in place of the missing bytes. */
  readonly missingBytesMidpoint: number;
  readonly attributes: ByVertexRole<TexelRange>;
  readonly normalFormat: NormalFormat;
  /** Bits of a texture coordinate in its image: one byte (red, green), or two (red and blue, green and alpha). */
  readonly texCoordBits: 8 | 16;
  readonly colorComponents: 3 | 4;
  /** Values of the attribute that colors the geometry; undefined until its first byte plane is available. */
  readonly value: ValuePlanes | undefined;
}

/** Numbers in byte planes, most significant first. */
export interface ValuePlanes {
  /** The available planes. */
  readonly planes: readonly TexelRange[];
  readonly planeCount: number;
  /** Added to every stored number in place of the missing bytes. */
  readonly missingBytesMidpoint: number;
}

/** A typed array that the renderer has: on the GPU without a copy in JavaScript, or not uploaded yet. */
export interface GpuArray {
  readonly byteLength: number;
  /** How many times its elements have been replaced; absent: they do not change. */
  readonly version?: number;
  /** Frees the memory. */
  close(): void;
}

/** Vertices that change. */
export interface WritableArray {
  readonly bytes: GpuArray;
  /** Replaces all elements, by as many of the same type, before the next frame. */
  write(array: ElementArray): void;
}

/** WebGL must know the use beforehand: a buffer holds either vertices or indices. */
export type ArrayUse = "vertices" | "index";

/** A VertexArray on the GPU. */
export interface GpuVertices extends Omit<VertexArray, "array"> {
  readonly bytes: GpuArray;
  readonly type: ElementType;
}

/** Values of the attribute that colors a geometry. */
export interface GpuValues extends GpuVertices {
  /**
   * The stored integer of the upper end of the attribute's range, whose lower end is 0; undefined: numbers are stored
   * as they are.
   */
  readonly maxStored: number | undefined;
}

export interface GpuIndex {
  readonly bytes: GpuArray;
  readonly type: ElementType;
}

/**
 * A stage whose vertices are in buffers. Coordinates are stored integers (or floats), other attributes are normalized
 * to their range.
 */
export interface BufferStage extends StageHead {
  readonly kind: "buffers";
  /** Records of the patch in `coord`, whose file may hold more; 0: unknown. */
  readonly vertexCount: number;
  readonly index: GpuIndex | undefined;
  readonly coord: GpuVertices;
  /** Undefined: the vertices have not been in images. */
  readonly coordImage?: CoordImage | undefined;
  readonly attributes: ByVertexRole<GpuVertices>;
  /** Normals of two numbers of 8 bits may also be one 16-bit word, whose low byte is the first. */
  readonly normalFormat: NormalFormat;
  readonly value: GpuValues | undefined;
  /** What moves the vertices, if joints or displacers do. */
  readonly deformation?: Deformation | undefined;
  /** Takes the place of the shape's color texture: the image of a group of a level of detail. */
  readonly chips?: StageImage | undefined;
}

/** A texture image that belongs to a stage. */
export interface StageImage {
  readonly image: DecodedImage;
  readonly hasAlpha: boolean;
}

export type Stage = TextureStage | BufferStage;
