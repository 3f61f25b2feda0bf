// How the vertices of a stage are stored, as #defines and uniforms of materials.

import type { IUniform, Matrix3, Texture, Vector4 } from "three";
import type { Vec3 } from "../../document/description.ts";
import { instancesDefine } from "./instanceRecord.ts";
import type { ByVertexRole, VertexRole } from "../../stage/attributeRows.ts";
import { attributeRows, vertexRoles } from "../../stage/attributeRows.ts";
import type { Grid, NormalFormat } from "../../stage/stage.ts";
import { isPairFormat } from "../../stage/stage.ts";

/** Uniforms of both versions of the vertex chunk. */
export interface VertexUniforms extends Record<string, IUniform> {
  /** Device pixels per CSS pixel. */
  pixelRatio: IUniform<number>;
  /** Size, minimum and maximum size of points, in CSS pixels. */
  pointSizes: IUniform<Vec3>;
  /** At distance r points are 1 / (a + b r + c r^2) as large. */
  attenuation: IUniform<Vec3>;
  /** By set: the texture coordinates of a stored 0 (two numbers), and the extent up to a stored 1. */
  texCoordFrames: IUniform<readonly number[]>;
  /** Texture transforms in the order of textureRoles. */
  textureTransforms: IUniform<readonly Matrix3[]>;
  /** The set of texture coordinates of each texture, likewise. */
  textureSets: IUniform<readonly number[]>;
  /** The size of a lattice step along each axis, in the shape's coordinates. */
  latticeStep: IUniform<Vec3>;
  /** LineDescription's width and dashes, for wide lines. */
  lineWidth: IUniform<number>;
  dashes: IUniform<readonly number[]>;
  dashCount: IUniform<number>;
  viewport: IUniform<Vector4>;
}

/** Further uniforms of the image version. Textures that have not loaded are null and read as 0. */
export interface ImageVertexUniforms extends VertexUniforms, Record<`${VertexRole}Image`, IUniform<Texture | null>> {
  indexImage: IUniform<Texture | null>;
  coordImage0: IUniform<Texture | null>;
  coordImage1: IUniform<Texture | null>;
  coordImage2: IUniform<Texture | null>;
  coordImage3: IUniform<Texture | null>;
  /** First texels of the index and of the attributes, at the positions that `glslFirstTexelOf` names. */
  firstTexels: IUniform<readonly number[]>;
  coordFirstTexels: IUniform<[number, number, number, number]>;
  coordPlaneCount: IUniform<number>;
  missingBytesMidpoint: IUniform<number>;
  hasIndex: IUniform<boolean>;
  isIndexWide: IUniform<boolean>;
  implicitWidth: IUniform<number>;
  /**
   * Columns and rows of a grid's vertices, and whether its last column is joined to the first; used with
   * gridDefinesOf.
   */
  gridSize: IUniform<[number, number]>;
  /** First column and row of a height map's image in the whole map, then columns and rows of the map. */
  gridPart: IUniform<[number, number, number, number]>;
  isGridClosed: IUniform<boolean>;
  /** The stored integer of the far side of the bounding box. */
  maxStoredValue: IUniform<number>;
  /** The sequence index at which the draw begins, and whether it is a strip. */
  firstSequenceIndex: IUniform<number>;
  isStrip: IUniform<boolean>;
  /** Lines of the draw, at least 1. A draw of several instances repeats all lines for each. */
  lineCount: IUniform<number>;
  areTexCoordsBytes: IUniform<boolean>;
  colorHasAlpha: IUniform<boolean>;
  /** Records of the patch. */
  recordCount: IUniform<number>;
}

/** Samplers in vertex shaders beside those of attributes: the index, coordinates (4), values (3), instance records. */
const otherSamplerCount = 9;
/** Samplers in vertex shaders, hence texture units that a vertex shader must have. */
export const minVertexTextureUnits = otherSamplerCount + vertexRoles.length;

/** Defined in materials that read vertices from images. */
export const imageVerticesDefine = "IMAGE_VERTICES";
/** Defined in those of them that read normals. */
export const imageNormalsDefine = "IMAGE_NORMALS";
/** Defined in materials that light in linear space: vertex colours are sRGB. */
export const srgbColorsDefine = "SRGB_VERTEX_COLORS";
/** Defined in materials that read vertices after the operator blur: it makes shaders slower to compile and to run. */
export const blurredDefine = "BLURRED";
/** Defined in materials of shapes with operators. */
export const operatorsDefine = "OPERATORS";

/** Defined in materials of wide lines; its value is the number of vertices from the start of one line to the next. */
export const wideLinesDefine = "WIDE_LINES";

/** Defined in materials of points that are drawn at least as wide as their spacing. */
export const pointSpacingDefine = "POINT_SPACING";

/** How the vertices of a draw are read. */
export interface VertexFormat {
  /** Whether they are in images; otherwise in buffers. */
  readonly isFromImages: boolean;
  /** As attributeDefinesOf returns them. */
  readonly attributeDefines: Readonly<Record<string, string>>;
  /** As gridDefinesOf returns them. */
  readonly gridDefines: Readonly<Record<string, string>>;
  /** As normalDefinesOf returns them. */
  readonly normalDefines: Readonly<Record<string, string>>;
  /** Those of `OperatedFormat`; absent where no operators map the vertices. */
  readonly operatorDefines?: Readonly<Record<string, string>> | undefined;
  /** As deformationDefinesOf returns them; absent where vertices do not move. */
  readonly deformationDefines?: Readonly<Record<string, string>> | undefined;
  /** Whether each instance has a record (shaders/instanceRecord.ts); otherwise the object's matrix transforms it. */
  readonly isInstanced: boolean;
  /** Whether points are drawn at least as wide as their spacing, the uniform `pointSpacing`. */
  readonly hasPointSpacing?: boolean;
  /** For wide lines, the distance in vertices from one line to the next; 0: no wide lines. */
  readonly wideLineStep: 0 | 1 | 2;
}

/** Whether a material needs the uniform `viewport` (followViewport). */
export function needsViewport({ wideLineStep, hasPointSpacing = false }: VertexFormat): boolean {
  return wideLineStep > 0 || hasPointSpacing;
}

/** The #defines of a material that reads vertices of this format. */
export function vertexDefinesOf(
  {
    isFromImages,
    attributeDefines,
    gridDefines,
    normalDefines,
    operatorDefines,
    deformationDefines,
    isInstanced,
    hasPointSpacing = false,
    wideLineStep,
  }: VertexFormat,
  readsNormals: boolean,
): Record<string, string> {
  return {
    ...(isFromImages && { [imageVerticesDefine]: "" }),
    ...(isFromImages && readsNormals && { [imageNormalsDefine]: "" }),
    ...attributeDefines,
    ...(isInstanced && { [instancesDefine]: "" }),
    ...(hasPointSpacing && { [pointSpacingDefine]: "" }),
    ...(wideLineStep > 0 && { [wideLinesDefine]: `${wideLineStep}` }),
    ...gridDefines,
    ...operatorDefines,
    ...deformationDefines,
    ...(readsNormals && normalDefines),
  };
}

/** The #defines for vertices after the operator blur; those of a grid get their normals from it. */
export function blurredDefinesOf(isGrid: boolean): Record<string, string> {
  return { [blurredDefine]: "", ...(isGrid && { BLURRED_NORMALS: "" }) };
}

/** The GLSL expression for the first texel of an image. */
export function glslFirstTexelOf(role: "index" | VertexRole): string {
  return `firstTexels[${["index", ...vertexRoles].indexOf(role)}]`;
}

/** The #defines for the attributes that vertices have. */
export function attributeDefinesOf(attributes: ByVertexRole<unknown>): Record<string, string> {
  const present = vertexRoles.filter((role) => attributes[role] !== undefined);
  return Object.fromEntries(present.flatMap((role) => attributeRows[role].define ?? []).map((name) => [name, ""]));
}

/** The #defines for stored normals. `isWord`: both numbers in one 16-bit word. */
export function normalDefinesOf(format: NormalFormat, isWord: boolean): Record<string, string> {
  if (!isPairFormat(format)) return format.kind === "byteVector" ? { NORMAL_BYTES: "" } : {};
  return {
    [format.kind === "octahedral" ? "OCTAHEDRAL_NORMALS" : "SPHERICAL_NORMALS"]: "",
    NORMAL_MAX: `${2 ** format.bits - 1}.0`,
    ...(format.bits === 16 && { NORMAL_WORD_TEXELS: "" }),
    ...(isWord && { NORMAL_WORDS: "" }),
  };
}

/** The #defines for a grid in the image version: how vertices are found, and their normals where none are stored. */
export function gridDefinesOf(grid: Grid | undefined, hasNormals: boolean): Record<string, string> {
  if (grid === undefined) return {};
  return {
    GRID: "",
    ...(grid.kind === "heightMap" && { GRID_HEIGHTS: "" }),
    ...(!hasNormals && { GRID_NORMALS: "" }),
  };
}
