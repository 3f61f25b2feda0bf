// A scene as plain data: the fields of a document's nodes with every default filled in. Descriptions are immutable.

import type { AppearanceDescription } from "./appearanceDescription.ts";
import type { SceneElement } from "./element.ts";
import type { Rotation, Vec2, Vec3, Vec4 } from "./fieldTypes.ts";
import type { Box3, GeometryDescription } from "./geometryDescription.ts";
import type { CubeMapDescription, PanoramaPicture } from "./panoramaDescription.ts";
import type { nodeFields, Values, Warning } from "./nodes.ts";

export * from "./appearanceDescription.ts";
export * from "./geometryDescription.ts";
export * from "./imageDescription.ts";
export * from "./panoramaDescription.ts";

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
  /**
   * Why the shape's geometry element is not drawn: the sentence for an `error` event where no reader knows it, else "".
   * Undefined where there is a geometry, or no element for one.
   */
  readonly unreadableGeometry: string | undefined;
  /** Live streams only. */
  readonly playback?: Playback;
  /** What moves the vertices; its geometry then has a `deformation`. */
  readonly deformer?: DeformerDescription | undefined;
}

/** The joints of an HAnimHumanoid, which move the vertices of the shapes in it. */
export interface SkinDescription {
  /** Elements of Transforms, in the order in which vertices name them. */
  readonly joints: readonly SceneElement[];
  /**
   * 16 numbers for each joint, column by column: from the coordinates of the shapes, as they were modelled, to those of
   * the joint.
   */
  readonly inverseBindMatrices: readonly number[];
}

/** What moves the vertices of a shape. */
export interface DeformerDescription {
  readonly skin: SkinDescription | undefined;
  /** HAnimDisplacers, in the order of the displacements. */
  readonly displacers: readonly { readonly element: SceneElement; readonly weight: number }[];
}

/** How a live stream is followed. */
export interface Playback {
  readonly paused: boolean;
  /** The largest number of frames per second; 0: all. */
  readonly rate: number;
}

export interface GroupDescription {
  readonly kind: "group";
  readonly visible: boolean;
  /** Bounds of its children, in their coordinates; undefined where the document has none. */
  readonly box: Box3 | undefined;
  /** Undefined for a plain Group. */
  readonly transform: TransformDescription | undefined;
  /** The identity of a Transform: of a USEd one, the element that is USEd. */
  readonly transformElement?: SceneElement;
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

/** X3D's EnvironmentLight: light from all around, which PhysicalMaterials reflect. */
export interface EnvironmentLightDescription {
  readonly kind: "environmentLight";
  /** Its identity. */
  readonly element: SceneElement;
  readonly on: boolean;
  /** False: it lights the children of its group only. */
  readonly global: boolean;
  readonly color: Vec3;
  readonly intensity: number;
  readonly ambientIntensity: number;
  readonly rotation: Rotation;
  /** What surfaces mirror. */
  readonly specular: CubeMapDescription | undefined;
  /** The light that falls on a surface, by the direction of its normal. Undefined: it is computed from `specular`. */
  readonly diffuse: CubeMapDescription | undefined;
  /** The same as nine spherical harmonics, three numbers each; empty: none. */
  readonly diffuseCoefficients: readonly number[];
}

export type NodeDescription =
  | GroupDescription
  | ShapeDescription
  | LightNodeDescription
  | ViewpointNodeDescription
  | BackgroundNodeDescription
  | ClipPlaneDescription
  | FogNodeDescription
  | LocalFogDescription
  | EnvironmentLightDescription;

/** A color at an angle, in radians, from the zenith or the nadir. */
export interface Ring {
  readonly angle: number;
  readonly color: Vec3;
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
