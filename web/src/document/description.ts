// A scene as plain data: what the document says, with every default filled in.
// The names are those of src/scene/scene.h and src/containers/geometry.h.

import type { SceneElement } from "./element.ts";
import type { Rotation, Vec2, Vec3 } from "./fieldTypes.ts";
import type { nodeFields, Values, Warning } from "./nodes.ts";

export interface Box3 {
  readonly min: Vec3;
  readonly max: Vec3;
}

export type Primitive = "points" | "lines" | "lineStrip" | "triangles" | "triangleStrip";

/** `count` indices (records, where there is no index) drawn as one kind of primitive, following the previous draw's. */
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

/** One patch, or one base mesh, of those that a file holds (compact). */
export interface PatchReference {
  readonly url: string;
  /** Index of the patch, or of the base mesh, in the file. */
  readonly patchIndex: number;
}

/** Where data lies in a file. All references of a geometry are of the kind that its encoding has. */
export type Reference = TexelReference | ByteReference | PatchReference;

/** A surface over a grid of texels: stage/stage.ts says the same to those who draw it. */
export interface GridDescription {
  readonly kind: Exclude<MeshMode, "sig">;
  readonly columns: number;
  readonly rows: number;
}

export interface PatchDescription {
  /** Tight, for culling and priority; undefined where the document has none. */
  readonly box: Box3 | undefined;
  /** Records in coord, normal, …; 0: as many as there are. */
  readonly vertexCount: number;
  readonly draws: readonly Draw[];
  /** Running number n is texel (n mod implicitWidth, n div implicitWidth). Images only. */
  readonly implicitWidth: number;
  readonly implicitHeight: number;
  /** Instead of draws in the document. Images only. */
  readonly grid: GridDescription | undefined;
  /** Absent: records are drawn in order. */
  readonly index: Reference | undefined;
  /** Images: byte planes, most significant first. Typed arrays: one. */
  readonly coord: readonly Reference[];
  readonly normal: Reference | undefined;
  readonly texCoord: Reference | undefined;
  readonly color: Reference | undefined;
  /** Compact only: all of the patch. */
  readonly data: Reference | undefined;
  /** Of all further attributes, one after the other: each has `files`. */
  readonly attributes: readonly Reference[];
  /** Of the attribute that colours the geometry. */
  readonly value: readonly Reference[];
}

/** A further attribute of vertices. */
export interface AttributeDescription {
  readonly name: string;
  readonly components: 1 | 2 | 3 | 4;
  /** Files that it has in each patch: byte planes, most significant first, or one array; none in compact, whose patches hold it. */
  readonly fileCount: number;
  /** Bits of a stored integer; undefined: numbers are stored as they are. */
  readonly bits: number | undefined;
  /** By component: the box that stored integers are spread over, or that numbers lie in. */
  readonly min: readonly number[];
  readonly size: readonly number[];
}

/** The colours that values have: the first at the range's begin, the last at its end. */
export interface ColorMapDescription {
  readonly colors: readonly Vec3[];
  readonly range: Vec2;
}

/** What an image geometry's texels mean: vertices and indices, or a surface over their grid. */
export const meshModes = ["sig", "heightMap", "geometryImage", "sculpt"] as const;
export type MeshMode = (typeof meshModes)[number];

export const elementTypes = ["Int8", "Uint8", "Int16", "Uint16", "Int32", "Uint32", "Float32"] as const;
export type ElementType = (typeof elementTypes)[number];

/** How unit normals are stored: as three components, as two numbers, or as RGB out of a palette. */
export const normalEncodings = ["rgb", "octahedral", "spherical", "palette"] as const;
export type NormalEncoding = (typeof normalEncodings)[number];

/** How patches lie in files: packed into one range of bytes (SIG compact), as byte planes in images (SIG classic), or as typed arrays (BG). */
export type Encoding = "compact" | "classic" | "bg";

/** The encodings of an ImageGeometry, by the values of its `profile` field. */
export const imageProfiles = ["classic", "compact"] as const;
export type ImageProfile = (typeof imageProfiles)[number];

export const decodeModes = ["auto", "gpu", "cpu"] as const;
export type DecodeMode = (typeof decodeModes)[number];

export interface GeometryDescription {
  readonly encoding: Encoding;
  /** Centre and extent of the box over which stored integers are spread. */
  readonly position: Vec3;
  readonly size: Vec3;
  /** Bits that carry the lattice, left-justified in the stored bytes; 0: all of them. */
  readonly positionBits: number;
  /** False: both sides are seen. */
  readonly solid: boolean;
  readonly texCoordMin: Vec2;
  readonly texCoordSize: Vec2;
  readonly colorComponents: 3 | 4;
  readonly normalEncoding: NormalEncoding;
  /** Where images are decoded: by the shader, in workers, or as is best. */
  readonly decode: DecodeMode;
  /** In images Uint16: column and row of the record, or Uint32: its number. */
  readonly indexType: ElementType;
  /** Typed arrays only, as the types below. */
  readonly coordType: ElementType;
  readonly normalType: ElementType;
  readonly texCoordType: ElementType;
  readonly colorType: ElementType;
  readonly attributes: readonly AttributeDescription[];
  /** The one whose values come with the vertices, and colour them. */
  readonly value: AttributeDescription | undefined;
  readonly patches: readonly PatchDescription[];
  /** The base mesh that stands in for the patches until they are here. */
  readonly base: Reference | undefined;
  /** Of a text: the picture that its letters are cut out with. */
  readonly glyphAtlas?: string;
}

/** Phong's model in the numbers of the screen, glTF's metallic-roughness model in linear ones, or a colour that no light changes. */
export type MaterialDescription =
  | ({ readonly kind: "phong" } & Values<typeof nodeFields.Material>)
  | ({ readonly kind: "physical" } & Values<typeof nodeFields.PhysicalMaterial>)
  | ({ readonly kind: "unlit" } & Values<typeof nodeFields.UnlitMaterial>);

/** What alpha means: AUTO blends where there is any. */
export interface AlphaDescription {
  readonly mode: "AUTO" | "OPAQUE" | "MASK" | "BLEND";
  /** Of MASK: what has less is not seen. */
  readonly cutoff: number;
}

export type WrapMode = "repeat" | "clamp" | "mirror";

/** How a texture is read between and beyond its texels. */
export interface SamplingDescription {
  /** Numbers that shading computes with, not colours that people look at. */
  readonly isData: boolean;
  readonly wrapS: WrapMode;
  readonly wrapT: WrapMode;
  /** False: seen large, its texels are squares. */
  readonly isSmooth: boolean;
  readonly hasMipmaps: boolean;
  readonly anisotropy: number;
  /** Alpha is no share but how far an edge is, as render/letterField.ts reads it. */
  readonly isDistanceField?: true;
}

/** 3 x 3, column by column. */
export type TextureMatrix = readonly [number, number, number, number, number, number, number, number, number];

/** The part of a material that a texture modulates. `color` is that of diffuseColor, baseColor or an UnlitMaterial's emissiveColor. */
export const textureRoles = [
  "color",
  "emissive",
  "metallicRoughness",
  "normal",
  "occlusion",
  "ambient",
  "specular",
  "shininess",
] as const;
export type TextureRole = (typeof textureRoles)[number];

export interface TextureDescription {
  readonly role: TextureRole;
  readonly url: string;
  /** Of the same picture in few pixels, shown until it is here; empty: there is none. */
  readonly preview: string;
  readonly sampling: SamplingDescription;
  /** From a vertex's texture coordinates to the image's. */
  readonly transform: TextureMatrix;
}

/** X3D's PointProperties, in CSS pixels. */
export interface PointDescription {
  readonly size: number;
  readonly minSize: number;
  readonly maxSize: number;
  /** At distance r points are 1 / (a + b r + c r^2) as large. */
  readonly attenuation: Vec3;
}

/** X3D's LineProperties, of lines that are not solid and as thin as can be. */
export interface LineDescription {
  /** In CSS pixels. */
  readonly width: number;
  /** Lengths that are drawn and left out in turn, in widths, an even number of them; none of a solid line. */
  readonly dashes: readonly number[];
}

export interface AppearanceDescription {
  readonly material: MaterialDescription;
  readonly alpha: AlphaDescription;
  /** At most one of each role. */
  readonly textures: readonly TextureDescription[];
  readonly points: PointDescription | undefined;
  /** Undefined: as thin as the GPU draws them. */
  readonly lines: LineDescription | undefined;
  /** In place of the material's diffuse colour, of a geometry whose vertices have values. */
  readonly colorMap: ColorMapDescription | undefined;
}
export interface ViewpointDescription extends Values<typeof nodeFields.Viewpoint> {
  /** Width over height of what a view of any shape has to show at least; 1 where nothing is said. */
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
   * Who this is: two readings of a document speak of one shape when their elements
   * are the same. It stands in several places where a group around it is USEd.
   */
  readonly element: SceneElement;
  /** The element of the page that stands for it: itself, or the Inline whose document it is in. */
  readonly host: SceneElement;
  /** False where it or a group around it is hidden. */
  readonly visible: boolean;
  /** Whether the scene ends no nearer than it: it is seen, or would be in another level of a LOD. */
  readonly contributesToBounds: boolean;
  /** What the author says of it, of its geometry and of the groups around it, multiplied. */
  readonly priority: number;
  /** False: the pointer goes through it to what lies behind. */
  readonly isPickable: boolean;
  /** Tight, in the shape's own coordinates; undefined where neither the shape nor its geometry has one. */
  readonly box: Box3 | undefined;
  readonly appearance: AppearanceDescription;
  /** Undefined where the shape has no geometry that we can show; the same object for shapes that USE one. */
  readonly geometry: GeometryDescription | undefined;
  /** It has a geometry all the same: damaged, or of a kind that the reader has no means for. */
  readonly isUnread: boolean;
}

export interface GroupDescription {
  readonly kind: "group";
  readonly visible: boolean;
  /** Around its children, in their coordinates, where the document tells. */
  readonly box: Box3 | undefined;
  /** Undefined for a plain Group. */
  readonly transform: TransformDescription | undefined;
  /** Of a LOD, whose children these are, one of them visible. */
  readonly lod?: LodDescription;
  /** Of an Inline that names a document: who this is, as a shape's. */
  readonly inline?: SceneElement;
  /** Of a Billboard: it turns about this axis so that its z axis points to the viewer; 0 0 0: and its y axis up in the picture. */
  readonly billboardAxis?: Vec3;
  readonly anchor?: AnchorDescription;
  readonly children: readonly NodeDescription[];
}

/** What a click on something in an Anchor leads to. */
export interface AnchorDescription {
  /** Who this is, as a shape's. */
  readonly element: SceneElement;
  /** The first that may be followed counts; as the document has them. */
  readonly urls: readonly string[];
  readonly description: string;
  /** As of an `<a>`; empty: this window. */
  readonly target: string;
}

/** A LOD whose level depends on how far the viewer is from it. */
export interface LodDescription {
  /** Who this is, as a shape's. */
  readonly element: SceneElement;
  readonly center: Vec3;
  /** Where one level ends and the next begins, ascending. */
  readonly range: readonly number[];
  /** The last one is that of all greater distances. */
  readonly levelCount: number;
}

/** A document to be shown where an Inline stands. */
export interface InlineDescription {
  readonly element: SceneElement;
  /** The first that leads to a document counts. */
  readonly urls: readonly string[];
  /** What is hidden is not asked for. */
  readonly visible: boolean;
  readonly priority: number;
}

export interface LightNodeDescription {
  readonly kind: "light";
  readonly light: LightDescription;
}

export interface ViewpointNodeDescription {
  readonly kind: "viewpoint";
  /** Who this is, as a shape's. */
  readonly element: SceneElement;
  readonly viewpoint: ViewpointDescription;
}

export type NodeDescription = GroupDescription | ShapeDescription | LightNodeDescription | ViewpointNodeDescription;

/** The colour at an angle, in radians, from the zenith or the nadir. */
export interface Ring {
  readonly angle: number;
  readonly color: Vec3;
}

export interface BackgroundDescription {
  /** From the zenith on; at least one. */
  readonly sky: readonly Ring[];
  /** From the nadir on, before the sky. */
  readonly ground: readonly Ring[];
}

export interface SceneDescription {
  readonly root: GroupDescription;
  /** The one that is bound: the first in the document, or the last that says so. */
  readonly navigation: NavigationDescription;
  /** Undefined: nothing behind the scene, the page shows through. */
  readonly background: BackgroundDescription | undefined;
  /** Changes to the weights of what files hold, as the author writes them. */
  readonly chunkPriority: string;
  /** In document order, those in inlined documents too; one that is USEd, and one of a document that is shown twice, once for each place. */
  readonly inlines: readonly InlineDescription[];
  readonly warnings: readonly Warning[];
}

/** Every shape below a node, in document order, once for each place where it stands. */
export function shapesOf(node: NodeDescription): ShapeDescription[] {
  if (node.kind === "shape") return [node];
  return node.kind === "group" ? node.children.flatMap(shapesOf) : [];
}

/** Every viewpoint below a node, in document order. */
export function viewpointsOf(node: NodeDescription): ViewpointNodeDescription[] {
  if (node.kind === "viewpoint") return [node];
  return node.kind === "group" ? node.children.flatMap(viewpointsOf) : [];
}

export type { Rotation, Vec2, Vec3, Warning };
