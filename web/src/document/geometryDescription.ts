// The geometry of a shape as plain data: its encoding, its patches, and where their data lies in files.

import type { DeformationLayout } from "../stage/deformation.ts";
import type { ElementType } from "../stage/elementType.ts";
import type { GridPart } from "../stage/stage.ts";
import type { VertexRole } from "../stage/attributeRows.ts";
import type { Vec2, Vec3 } from "./fieldTypes.ts";
import type { MovingGeometry } from "./movingGeometry.ts";

export interface Box3 {
  readonly min: Vec3;
  readonly max: Vec3;
}

export type Primitive = "points" | "lines" | "lineStrip" | "lineLoop" | "triangles" | "triangleStrip" | "triangleFan";

/**
 * `count` indices (vertices, where there is no index) drawn as one kind of primitive, following the previous draw's.
 */
export interface Draw {
  readonly primitive: Primitive;
  readonly count: number;
}

/** A file. */
interface FileReference {
  readonly url: string;
  /** Tried in order where `url` cannot be loaded. */
  readonly furtherUrls?: readonly string[];
}

/** Texels of an image, from `firstTexel` on, row by row (classic). */
export interface TexelReference extends FileReference {
  readonly firstTexel: number;
}

/** Elements of typed arrays (BG). */
export interface ByteReference extends FileReference {
  readonly byteOffset: number;
  /** Bytes from one element to the next; 0: tightly packed. */
  readonly byteStride: number;
}

/** A patch or a base mesh in a file that may hold several (compact). */
export interface PatchReference extends FileReference {
  /** Index of the patch, or of the base mesh, in the file. */
  readonly patchIndex: number;
}

/** Where data lies in a file. All references of a geometry are of the kind that its encoding has. */
export type Reference = TexelReference | ByteReference | PatchReference;

/** A surface over a grid of texels. */
export interface GridDescription {
  readonly kind: Exclude<MeshMode, "sig">;
  readonly columns: number;
  readonly rows: number;
  /** Undefined: the grid is a whole height map, or no height map. */
  readonly part?: GridPart | undefined;
}

export interface PatchDescription extends Readonly<Record<VertexRole, Reference | undefined>> {
  /** The tight bounding box; undefined where the document has none. */
  readonly box: Box3 | undefined;
  /** Vertices in coord, normal, …; 0: as many as the data has. */
  readonly vertexCount: number;
  readonly draws: readonly Draw[];
  /** Vertex n is texel (n mod implicitWidth, n div implicitWidth). Images only. */
  readonly implicitWidth: number;
  readonly implicitHeight: number;
  /** A surface over the texels, which replaces the document's draws. Images only. */
  readonly grid: GridDescription | undefined;
  /** Height maps: column and row of the first vertex in the whole map. */
  readonly gridOrigin: Vec2;
  /** Undefined: vertices are drawn in order. */
  readonly index: Reference | undefined;
  /** Images: byte planes, most significant first. Typed arrays: one. */
  readonly coord: readonly Reference[];
  /**
   * Classic only: further images of an attribute, each with the next lower byte of its numbers; one or more. For
   * normals as vectors, for colors, and for texture coordinates, whose first image has two bytes.
   */
  readonly lowBytes: Readonly<Partial<Record<VertexRole, readonly Reference[]>>>;
  /** Compact only: all of the patch. */
  readonly data: Reference | undefined;
  /** The files of all further attributes, one after the other, `fileCount` each. */
  readonly attributes: readonly Reference[];
  /** The files of `GeometryDescription.value`. */
  readonly value: readonly Reference[];
  /** The files of the attributes of `GeometryDescription.deformation`, one after the other. */
  readonly deformation?: readonly Reference[];
}

/** A custom vertex attribute (FloatVertexAttribute). */
export interface AttributeDescription {
  readonly name: string;
  readonly components: 1 | 2 | 3 | 4;
  /**
   * Its files in each patch: byte planes, most significant first, or one array; 0 for compact, whose patches hold it.
   */
  readonly fileCount: number;
  /** Bits of a stored integer; undefined: floats are stored as they are. */
  readonly bits: number | undefined;
  /** By component: the range that stored integers are quantized over, or that floats lie in. */
  readonly min: readonly number[];
  readonly size: readonly number[];
  /** For values from a live stream: the range that it states; for several components, that of their length. */
  readonly streamedRange?: Vec2;
}

/** The attributes of a geometry that move its vertices, in the order of the texels of a `Deformation`. */
export interface DeformationDescription {
  readonly layout: DeformationLayout;
  readonly attributes: readonly AttributeDescription[];
}

/** The use of the attribute whose values shaders read: they color the vertices, or are their depths in fog. */
export type ValueUse = "color" | "fogDepth";

/** The name of the attribute that holds depths in fog (FogCoordinate). */
export const fogDepthName = "fogDepth";

/** The meaning of an image geometry's texels: vertices and indices, or a surface over their grid. */
export const meshModes = ["sig", "heightMap", "geometryImage", "sculpt"] as const;
export type MeshMode = (typeof meshModes)[number];

/** The encoding of unit normals: three components, two numbers, or RGB from a palette. */
export const normalEncodings = ["rgb", "octahedral", "spherical", "palette"] as const;
export type NormalEncoding = (typeof normalEncodings)[number];

/** Whether normals are two numbers: octahedral x and y, or spherical phi and theta. */
export function isPair(encoding: NormalEncoding): encoding is "octahedral" | "spherical" {
  return encoding === "octahedral" || encoding === "spherical";
}

/** Bits of two numbers in a texel: each one byte, or two bytes (red and blue, green and alpha). */
export type PairBits = 8 | 16;

/**
 * How patches lie in files: packed into one range of bytes (SIG compact), as byte planes in images (SIG classic), as
 * typed arrays (BG), or as classic with coordinates that a live stream sends.
 */
export type Encoding = "compact" | "classic" | "bg" | "live";

/** The encodings of an ImageGeometry, by the values of its `profile` field. */
export const imageProfiles = ["classic", "compact"] as const;
export type ImageProfile = (typeof imageProfiles)[number];

export const decodeModes = ["auto", "gpu", "cpu"] as const;
export type DecodeMode = (typeof decodeModes)[number];

/** The range of a set of texture coordinates: those of a stored 0, and the extent up to a stored 1. */
export interface TexCoordBox {
  readonly min: Vec2;
  readonly size: Vec2;
}

/** A CoordinateInterpolator or a MovieTexture with the frames of a sequence. */
export interface SequenceDescription {
  /** The address of the index. */
  readonly url: string;
  /** The address of a lossless video of the same frames. */
  readonly video?: string;
  /** The interpolator or movie, as `interpolatorIdOf` numbers its element. */
  readonly interpolator: number;
}

/** A mesh as a graph of groups of triangles (docs/formats/levels.md). */
export interface LevelsDescription {
  /** The address of the first page of the index, beside which the groups are. */
  readonly url: string;
  /**
   * The set of texture coordinates, 1 to 3, of images of the groups' own, which take the place of the color texture;
   * absent: groups have none.
   */
  readonly chips?: number;
}

export interface GeometryDescription extends Readonly<Record<`${VertexRole}Type`, ElementType>> {
  readonly encoding: Encoding;
  /** Center and size of the box that stored integers are quantized over. */
  readonly position: Vec3;
  readonly size: Vec3;
  /** Quantization bits, left-justified in the stored bytes; 0: all bits. */
  readonly positionBits: number;
  /** False: both sides are drawn. */
  readonly solid: boolean;
  /** False: the front of a triangle is the side from which its corners run clockwise. */
  readonly ccw: boolean;
  /** By set of texture coordinates. */
  readonly texCoordBoxes: readonly TexCoordBox[];
  /** The names of the sets, which textures state as their mapping. */
  readonly texCoordMappings: readonly string[];
  readonly colorComponents: 3 | 4;
  readonly normalEncoding: NormalEncoding;
  /** Classic only: bits of each number of octahedral and spherical normals. */
  readonly normalBits: PairBits;
  /** Classic only: bits of a texture coordinate in the first image of a set. */
  readonly texCoordImageBits: PairBits;
  /** Where images are decoded: by the shader, in workers, or wherever is better. */
  readonly decode: DecodeMode;
  /** In images, Uint16 stands for the vertex's column and row, Uint32 for its index. */
  readonly indexType: ElementType;
  /** Typed arrays only, as are `normalType` and the types of the other attributes. */
  readonly coordType: ElementType;
  readonly attributes: readonly AttributeDescription[];
  /** The attribute whose values shaders read. */
  readonly value: AttributeDescription | undefined;
  /** Default: color. */
  readonly valueUse?: ValueUse;
  /** Present where joints or displacers may move the vertices. */
  readonly deformation?: DeformationDescription;
  readonly patches: readonly PatchDescription[];
  /** The base mesh that stands in for the patches until they are loaded. */
  readonly base: Reference | undefined;
  /** Geometry whose numbers are in the document and that animation moves: its vertices, in place of files. */
  readonly moving?: MovingGeometry;
  /** Set for a mesh with levels of detail; `patches` then holds one patch without data: the whole mesh. */
  readonly levels?: LevelsDescription;
  /** Text only: the URL of the glyph atlas. */
  readonly glyphAtlas?: string;
  /** Frames that replace the coordinates; the geometry's own are those of the first. */
  readonly sequence?: SequenceDescription;
}
