// A scene as plain data: the fields of a document's nodes with every default filled in. Descriptions are immutable.

import type { ElementType } from "../stage/elementType.ts";
import type { VertexRole } from "../stage/attributeRows.ts";
import type { SceneElement } from "./element.ts";
import type { Rotation, Vec2, Vec3, Vec4 } from "./fieldTypes.ts";
import type { nodeFields, Values, Warning } from "./nodes.ts";

export interface Box3 {
  readonly min: Vec3;
  readonly max: Vec3;
}

export type Primitive = "points" | "lines" | "lineStrip" | "triangles" | "triangleStrip";

/**
 * `count` indices (vertices, where there is no index) drawn as one kind of primitive, following the previous draw's.
 */
export interface Draw {
  readonly primitive: Primitive;
  readonly count: number;
}

/** Texels of an image, from `firstTexel` on, row by row (classic). */
export interface TexelReference {
  readonly url: string;
  readonly firstTexel: number;
}

/** Elements of typed arrays (BG). */
export interface ByteReference {
  readonly url: string;
  readonly byteOffset: number;
  /** Bytes from one element to the next; 0: tightly packed. */
  readonly byteStride: number;
}

/** A patch or a base mesh in a file that may hold several (compact). */
export interface PatchReference {
  readonly url: string;
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
  /** Undefined: vertices are drawn in order. */
  readonly index: Reference | undefined;
  /** Images: byte planes, most significant first. Typed arrays: one. */
  readonly coord: readonly Reference[];
  /** Compact only: all of the patch. */
  readonly data: Reference | undefined;
  /** The files of all further attributes, one after the other, `fileCount` each. */
  readonly attributes: readonly Reference[];
  /** The files of the attribute that colors the geometry. */
  readonly value: readonly Reference[];
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
}

/** Maps values to colors: the first color at the beginning of the range, the last at its end. */
export interface ColorMapDescription {
  readonly colors: readonly Vec3[];
  readonly range: Vec2;
}

/** The meaning of an image geometry's texels: vertices and indices, or a surface over their grid. */
export const meshModes = ["sig", "heightMap", "geometryImage", "sculpt"] as const;
export type MeshMode = (typeof meshModes)[number];

/** The encoding of unit normals: three components, two numbers, or RGB from a palette. */
export const normalEncodings = ["rgb", "octahedral", "spherical", "palette"] as const;
export type NormalEncoding = (typeof normalEncodings)[number];

/**
 * How patches lie in files: packed into one range of bytes (SIG compact), as byte planes in images (SIG classic), or as
 * typed arrays (BG).
 */
export type Encoding = "compact" | "classic" | "bg";

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

export interface GeometryDescription extends Readonly<Record<`${VertexRole}Type`, ElementType>> {
  readonly encoding: Encoding;
  /** Center and size of the box that stored integers are quantized over. */
  readonly position: Vec3;
  readonly size: Vec3;
  /** Quantization bits, left-justified in the stored bytes; 0: all bits. */
  readonly positionBits: number;
  /** False: both sides are drawn. */
  readonly solid: boolean;
  /** By set of texture coordinates. */
  readonly texCoordBoxes: readonly TexCoordBox[];
  /** The names of the sets, which textures state as their mapping. */
  readonly texCoordMappings: readonly string[];
  readonly colorComponents: 3 | 4;
  readonly normalEncoding: NormalEncoding;
  /** Where images are decoded: by the shader, in workers, or wherever is better. */
  readonly decode: DecodeMode;
  /** In images, Uint16 stands for the vertex's column and row, Uint32 for its index. */
  readonly indexType: ElementType;
  /** Typed arrays only, as are `normalType` and the types of the other attributes. */
  readonly coordType: ElementType;
  readonly attributes: readonly AttributeDescription[];
  /** The attribute whose values color the vertices. */
  readonly value: AttributeDescription | undefined;
  readonly patches: readonly PatchDescription[];
  /** The base mesh that stands in for the patches until they are loaded. */
  readonly base: Reference | undefined;
  /** Text only: the URL of the glyph atlas. */
  readonly glyphAtlas?: string;
}

/**
 * The fields of a PhysicalMaterial's extensions, with the defaults of those that it lacks. The strength of emission is
 * a factor of the material's emissiveColor already.
 */
export type MaterialExtensions = Values<typeof nodeFields.AnisotropyMaterialExtension> &
  Values<typeof nodeFields.ClearcoatMaterialExtension> &
  Values<typeof nodeFields.DispersionMaterialExtension> &
  Values<typeof nodeFields.IORMaterialExtension> &
  Values<typeof nodeFields.IridescenceMaterialExtension> &
  Values<typeof nodeFields.SheenMaterialExtension> &
  Values<typeof nodeFields.SpecularMaterialExtension> &
  Values<typeof nodeFields.TransmissionMaterialExtension> &
  Values<typeof nodeFields.VolumeMaterialExtension>;

/** X3D's Phong model, lit in sRGB; glTF's metallic-roughness model, lit in linear color; or an unlit color. */
export type MaterialDescription =
  | ({ readonly kind: "phong" } & Values<typeof nodeFields.Material>)
  | ({
      readonly kind: "physical";
      /** Undefined: the material has none. */
      readonly extensions?: MaterialExtensions | undefined;
    } & Values<typeof nodeFields.PhysicalMaterial>)
  | ({ readonly kind: "unlit" } & Values<typeof nodeFields.UnlitMaterial>);

/** The meaning of alpha. AUTO blends where the material or a texture is transparent. */
export interface AlphaDescription {
  readonly mode: "AUTO" | "OPAQUE" | "MASK" | "BLEND";
  /** MASK only: fragments with a lower alpha are not drawn. */
  readonly cutoff: number;
}

export type WrapMode = "repeat" | "clamp" | "mirror";

/** How a texture is filtered and wrapped. */
export interface SamplingDescription {
  /** The texels are numbers for shading instead of colors. */
  readonly isData: boolean;
  readonly wrapS: WrapMode;
  readonly wrapT: WrapMode;
  /** False: magnification shows square texels (nearest filter). */
  readonly isSmooth: boolean;
  readonly hasMipmaps: boolean;
  readonly anisotropy: number;
  /** Alpha is a signed distance to the nearest edge instead of an opacity. */
  readonly isDistanceField?: true;
}

/** 3 x 3, column by column. */
export type TextureMatrix = readonly [number, number, number, number, number, number, number, number, number];

/** The roles of the textures of PhysicalMaterial's extensions. */
export const extensionTextureRoles = [
  "anisotropy",
  "clearcoat",
  "clearcoatRoughness",
  "clearcoatNormal",
  "iridescence",
  "iridescenceThickness",
  "sheenColor",
  "sheenRoughness",
  "specularStrength",
  "specularColor",
  "transmission",
  "thickness",
] as const;
export type ExtensionTextureRole = (typeof extensionTextureRoles)[number];

/**
 * The material property that a texture modulates. `color` is diffuseColor, baseColor or an UnlitMaterial's
 * emissiveColor.
 */
export const textureRoles = [
  "color",
  "emissive",
  "metallicRoughness",
  "normal",
  "occlusion",
  "ambient",
  "specular",
  "shininess",
  ...extensionTextureRoles,
] as const;
export type TextureRole = (typeof textureRoles)[number];

/** An image and how it is sampled. */
export interface ImageDescription {
  readonly url: string;
  /** The URL of a small version, displayed until the image is loaded; empty: none. */
  readonly preview: string;
  readonly sampling: SamplingDescription;
}

export interface TextureDescription extends ImageDescription {
  readonly role: TextureRole;
  /** Maps a vertex's texture coordinates to the image's. */
  readonly transform: TextureMatrix;
  /** As written: the name of a set of texture coordinates, and of a transform; empty: the first. */
  readonly mapping: string;
  /** The set of texture coordinates of the shape's geometry that `mapping` names. */
  readonly texCoordSet: number;
}

/** X3D's PointProperties, in CSS pixels. */
export interface PointDescription {
  readonly size: number;
  readonly minSize: number;
  readonly maxSize: number;
  /** The size at distance r is divided by a + b r + c r². */
  readonly attenuation: Vec3;
}

/** X3D's LineProperties, for lines that are wider than one pixel or dashed. */
export interface LineDescription {
  /** In CSS pixels. */
  readonly width: number;
  /** Alternating lengths of dashes and gaps, in line widths, an even number of them; empty for a solid line. */
  readonly dashes: readonly number[];
}

export interface AppearanceDescription {
  readonly material: MaterialDescription;
  readonly alpha: AlphaDescription;
  /** At most one of each role. */
  readonly textures: readonly TextureDescription[];
  readonly points: PointDescription | undefined;
  /** Undefined: thin solid lines. */
  readonly lines: LineDescription | undefined;
  /** Replaces the material's diffuse color where the geometry's vertices have values. */
  readonly colorMap: ColorMapDescription | undefined;
}
export interface ViewpointDescription extends Values<typeof nodeFields.Viewpoint> {
  /** Width over height of the area that every view must show; 1 where absent. */
  readonly aspectRatio?: number;
}
export type NavigationDescription = Values<typeof nodeFields.NavigationInfo>;
export type LightDescription =
  | ({ readonly kind: "directional" } & Values<typeof nodeFields.DirectionalLight>)
  | ({ readonly kind: "point" } & Values<typeof nodeFields.PointLight>)
  | ({ readonly kind: "spot" } & Values<typeof nodeFields.SpotLight>);
export type TransformDescription = Values<typeof nodeFields.Transform>;

export interface ShapeDescription {
  readonly kind: "shape";
  /**
   * The shape's identity: descriptions of two readings are of one shape where their elements are the same. A shape
   * has several instances where a group around it is USEd.
   */
  readonly element: SceneElement;
  /** The page's element for it: itself, or the Inline element whose document it is in. */
  readonly host: SceneElement;
  /** False where the shape or a group around it is hidden. */
  readonly visible: boolean;
  /** Whether the scene's bounds include it: it is visible, or would be at another level of its LOD. */
  readonly contributesToBounds: boolean;
  /** The product of its own priority, its geometry's, and those of the groups around it. */
  readonly priority: number;
  /** False: picking ignores it. */
  readonly isPickable: boolean;
  /**
   * The tight bounding box in the shape's own coordinates; undefined where neither the shape nor its geometry has one.
   */
  readonly box: Box3 | undefined;
  readonly appearance: AppearanceDescription;
  /** Undefined where there is no geometry that can be drawn; the same object for shapes that USE one geometry. */
  readonly geometry: GeometryDescription | undefined;
  /** The shape has a geometry element that could not be read: malformed, or of a kind without reader. */
  readonly hasUnreadableGeometry: boolean;
}

export interface GroupDescription {
  readonly kind: "group";
  readonly visible: boolean;
  /** Bounds of its children, in their coordinates; undefined where the document has none. */
  readonly box: Box3 | undefined;
  /** Undefined for a plain Group. */
  readonly transform: TransformDescription | undefined;
  /** Present for a LOD, whose levels are the children, one of them visible. */
  readonly lod?: LodDescription;
  /** The identity of an Inline that names a document. */
  readonly inline?: SceneElement;
  /**
   * Present for a Billboard: it rotates about this axis so that its z axis faces the viewer. With 0 0 0, it rotates
   * freely, and its y axis also points up on the screen.
   */
  readonly billboardAxis?: Vec3;
  readonly anchor?: AnchorDescription;
  readonly children: readonly NodeDescription[];
}

/** The link that a click on an Anchor's descendant follows. */
export interface AnchorDescription {
  /** Its identity. */
  readonly element: SceneElement;
  /** As written in the document; the first one that may be followed counts. */
  readonly urls: readonly string[];
  readonly description: string;
  /** The browsing context, as in `<a target>`; empty: this one. */
  readonly target: string;
}

/** A LOD, whose visible level depends on the viewer's distance. */
export interface LodDescription {
  /** Its identity. */
  readonly element: SceneElement;
  readonly center: Vec3;
  /** The distances where one level ends and the next begins, ascending. */
  readonly range: readonly number[];
  /** The number of levels; the last one is for all distances beyond `range`. */
  readonly levelCount: number;
}

/** A document to be loaded for an Inline. */
export interface InlineDescription {
  readonly element: SceneElement;
  /** Tried in order until one loads. */
  readonly urls: readonly string[];
  /** A hidden Inline is not loaded. */
  readonly visible: boolean;
  readonly priority: number;
}

export interface LightNodeDescription {
  readonly kind: "light";
  readonly light: LightDescription;
}

export interface ViewpointNodeDescription {
  readonly kind: "viewpoint";
  /** Its identity. */
  readonly element: SceneElement;
  readonly viewpoint: ViewpointDescription;
}

/** X3D's ClipPlane: of its group, what is behind the plane is not drawn. */
export interface ClipPlaneDescription {
  readonly kind: "clipPlane";
  readonly enabled: boolean;
  /** a b c d: points with a x + b y + c z + d < 0 are behind it. */
  readonly plane: Vec4;
}

export interface FogDescription {
  readonly color: Vec3;
  readonly type: "linear" | "exponential";
  /** The distance at which the fog hides everything, in the node's coordinates; 0: no fog. */
  readonly visibilityRange: number;
}

/** X3D's Fog, for the whole scene. */
export interface FogNodeDescription {
  readonly kind: "fog";
  /** Its identity. */
  readonly element: SceneElement;
  /** The number of Inlines around it; 0 in the page's own document. */
  readonly inlineDepth: number;
  /** Whether `set_bind` or `bind` is true. */
  readonly isBindRequested: boolean;
  readonly fog: FogDescription;
}

/** X3D's LocalFog, for its group. */
export interface LocalFogDescription {
  readonly kind: "localFog";
  readonly enabled: boolean;
  readonly fog: FogDescription;
}

export type NodeDescription =
  | GroupDescription
  | ShapeDescription
  | LightNodeDescription
  | ViewpointNodeDescription
  | BackgroundNodeDescription
  | ClipPlaneDescription
  | FogNodeDescription
  | LocalFogDescription;

/** A color at an angle, in radians, from the zenith or the nadir. */
export interface Ring {
  readonly angle: number;
  readonly color: Vec3;
}

/** The sides of a panorama: -z, z, -x, x, y and -y of its node's coordinates. */
export const panoramaSides = ["front", "back", "left", "right", "top", "bottom"] as const;
export type PanoramaSide = (typeof panoramaSides)[number];

/** A picture that fills one side of a cube around the viewer. */
export interface PanoramaPicture extends ImageDescription {
  readonly role: PanoramaSide;
}

export interface BackgroundDescription {
  /** From the zenith downwards; at least one. */
  readonly sky: readonly Ring[];
  /** From the nadir upwards, in front of the sky. */
  readonly ground: readonly Ring[];
  /** The transparency of sky and ground: 0 opaque … 1 invisible, so that the page shows through. */
  readonly transparency: number;
  /** In front of sky and ground, at most one for each side. */
  readonly pictures: readonly PanoramaPicture[];
}

export interface BackgroundNodeDescription {
  readonly kind: "background";
  /** Its identity. */
  readonly element: SceneElement;
  /** The number of Inlines around it; 0 in the page's own document. */
  readonly inlineDepth: number;
  /** Whether `set_bind` or `bind` is true. */
  readonly isBindRequested: boolean;
  readonly background: BackgroundDescription;
}

export interface SceneDescription {
  readonly root: GroupDescription;
  /** The bound NavigationInfo: the first in the document, or the last whose `bind` or `set_bind` is true. */
  readonly navigation: NavigationDescription;
  /** The Background that is bound at the start; undefined: the page shows through behind the scene. */
  readonly background: BackgroundDescription | undefined;
  /** The author's changes to the weights of file contents, which order requests; as written. */
  readonly chunkPriority: string;
  /** In document order, including those of inlined documents; one entry for each instance. */
  readonly inlines: readonly InlineDescription[];
  readonly warnings: readonly Warning[];
}

/** All shapes below a node, in document order, once for each instance. */
export function shapesOf(node: NodeDescription): ShapeDescription[] {
  if (node.kind === "shape") return [node];
  return node.kind === "group" ? node.children.flatMap(shapesOf) : [];
}

/** All viewpoints below a node, in document order. */
export function viewpointsOf(node: NodeDescription): ViewpointNodeDescription[] {
  if (node.kind === "viewpoint") return [node];
  return node.kind === "group" ? node.children.flatMap(viewpointsOf) : [];
}

export type { Rotation, Vec2, Vec3, Vec4, Warning };
