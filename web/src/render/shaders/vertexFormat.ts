import type { IUniform, Matrix3, Texture, Vector4 } from "three";
import type { Vec3 } from "../../document/description.ts";
import { instancesDefine } from "./instanceRecord.ts";
import { wideLinesDefine } from "./wideLineChunk.ts";
import type { Grid, NormalCode } from "../../stage/stage.ts";
import { isPairCode } from "../../stage/stage.ts";

/** What both bodies read, as uniforms. */
export interface VertexUniforms extends Record<string, IUniform> {
  /** Device pixels in a CSS pixel. */
  pixelRatio: IUniform<number>;
  /** In CSS pixels: the size of a point, and its bounds. */
  pointSizes: IUniform<Vec3>;
  /** At distance r points are 1 / (a + b r + c r^2) as large. */
  attenuation: IUniform<Vec3>;
  /** Where stored texture coordinates 0 and 1 lie: origin and extent. */
  texCoordFrame: IUniform<[number, number, number, number]>;
  /** From there to the surfaceTextures, by textureRoles. */
  textureTransforms: IUniform<readonly Matrix3[]>;
  /** Along each axis, in the shape's coordinates. */
  latticeStep: IUniform<Vec3>;
  /** Of lines that are wide: LineDescription's width and dashes, as many as count. */
  lineWidth: IUniform<number>;
  dashes: IUniform<readonly number[]>;
  dashCount: IUniform<number>;
  viewport: IUniform<Vector4>;
}

/** What the image body reads besides. Textures that have not come are null and read as 0. */
export interface ImageVertexUniforms extends VertexUniforms {
  indexImage: IUniform<Texture | null>;
  coordImage0: IUniform<Texture | null>;
  coordImage1: IUniform<Texture | null>;
  coordImage2: IUniform<Texture | null>;
  coordImage3: IUniform<Texture | null>;
  normalImage: IUniform<Texture | null>;
  colorImage: IUniform<Texture | null>;
  texCoordImage: IUniform<Texture | null>;
  /** First texels: index, normal, colour, texture coordinates. */
  firstTexels: IUniform<[number, number, number, number]>;
  coordFirstTexels: IUniform<[number, number, number, number]>;
  coordPlanes: IUniform<number>;
  missingBytesMidpoint: IUniform<number>;
  hasIndex: IUniform<boolean>;
  isIndexWide: IUniform<boolean>;
  implicitWidth: IUniform<number>;
  /** Columns and rows of a grid's vertices, and whether its last column is joined to the first; used with gridDefinesOf. */
  gridSize: IUniform<[number, number]>;
  isGridClosed: IUniform<boolean>;
  /** The stored integer that stands for the far side of the box. */
  largestStored: IUniform<number>;
  /** The running number that the draw begins at, and whether it is a strip. */
  firstSequenceIndex: IUniform<number>;
  isStrip: IUniform<boolean>;
  /** Of the draw, at least 1: instances are its lines, in one place after the other. */
  lineCount: IUniform<number>;
  colorHasAlpha: IUniform<boolean>;
}

/** Samplers that the image body, values and places declare, and so texture units that a vertex shader must have. */
export const minVertexTextureUnits = 12;
/** Defined in materials that read images, and in those that read normals from them. */
export const imageVerticesDefine = "IMAGE_VERTICES";
export const imageNormalsDefine = "IMAGE_NORMALS";
/** Defined in materials that light in linear space: colours of vertices are sRGB, as everything that people see in files. */
export const srgbColorsDefine = "SRGB_VERTEX_COLORS";
/** How the vertices of a stage are found. */
export interface VertexFormat {
  /** They come from images, not from buffers. */
  readonly isFromImages: boolean;
  readonly hasTexCoords: boolean;
  /** As gridDefinesOf says it. */
  readonly gridDefines: Readonly<Record<string, string>>;
  /** As normalDefinesOf says it. */
  readonly normalDefines: Readonly<Record<string, string>>;
  /** Each in the place whose number comes with it; otherwise the object's matrix says where. */
  readonly isInstanced: boolean;
  /** Of wide lines, how many vertices on the next begins; 0: they are none. */
  readonly wideLineStep: 0 | 1 | 2;
}

/** What a material must define to read vertices of this form. */
export function vertexDefinesOf(
  { isFromImages, hasTexCoords, gridDefines, normalDefines, isInstanced, wideLineStep }: VertexFormat,
  readsNormals: boolean,
): Record<string, string> {
  return {
    ...(isFromImages && { [imageVerticesDefine]: "" }),
    ...(isFromImages && readsNormals && { [imageNormalsDefine]: "" }),
    ...(hasTexCoords && { HAS_TEX_COORDS: "" }),
    ...(isInstanced && { [instancesDefine]: "" }),
    ...(wideLineStep > 0 && { [wideLinesDefine]: `${wideLineStep}` }),
    ...gridDefines,
    ...(readsNormals && normalDefines),
  };
}

/** How a material's normals are stored, as defines. `isWord`: both numbers in one of 16 bits. */
export function normalDefinesOf(code: NormalCode, isWord: boolean): Record<string, string> {
  if (!isPairCode(code)) return code.kind === "byteVector" ? { NORMAL_BYTES: "" } : {};
  return {
    [code.kind === "octahedral" ? "OCTAHEDRAL_NORMALS" : "SPHERICAL_NORMALS"]: "",
    NORMAL_LARGEST: `${2 ** code.bits - 1}.0`,
    ...(isWord && { NORMAL_WORDS: "" }),
  };
}

/** What a grid changes in the image body, as defines: where its vertices are, and its normals where it has no others. */
export function gridDefinesOf(grid: Grid | undefined, hasNormals: boolean): Record<string, string> {
  if (grid === undefined) return {};
  return {
    GRID: "",
    ...(grid.kind === "heightMap" && { GRID_HEIGHTS: "" }),
    ...(!hasNormals && { GRID_NORMALS: "" }),
  };
}
