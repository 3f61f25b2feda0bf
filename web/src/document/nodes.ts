// The table of nodes and fields that the runtime reads, with types and defaults. tests/nodes.test.ts compares it with
// docs/formats/nodes.md and with the converter's table. A few attributes that are not fields of one node (DEF, USE,
// containerField, mapping) are read elsewhere in this folder.

import type { SceneElement } from "./element.ts";
import { attributesOf } from "./element.ts";
import type { Field } from "./fieldTypes.ts";
import {
  MFColor,
  MFFloat,
  MFInt32,
  MFMatrix4f,
  MFString,
  MFText,
  MFUrl,
  optional,
  Priority,
  SFBool,
  SFColor,
  SFFloat,
  SFImage,
  SFInt32,
  SFRotation,
  SFString,
  SFVec2f,
  SFVec3f,
  SFVec4f,
} from "./fieldTypes.ts";
import { ColorMap } from "./colorMaps.ts";
import { noPixels } from "./pixelImage.ts";

/** True: the node is bound (set_bind is X3D's event, bind X3DOM's field). */
const bindable = { set_bind: SFBool(false), bind: SFBool(false) };

/** X3D 4's `visible` and X3DOM's older `render`: a node is visible where both are true. */
const visibleObject = { visible: SFBool(true), render: SFBool(true) };

/** Download priority, multiplied down the tree. */
const prioritized = { priority: Priority(1) };

const boundedObject = {
  bboxCenter: SFVec3f([0, 0, 0]),
  bboxSize: SFVec3f([-1, -1, -1]),
};

const patchFields = {
  primType: MFString(["TRIANGLES"]),
  vertexCount: MFInt32([0]),
  implicitMeshSize: SFVec2f([256, 256]),
  index: MFUrl([]),
  coord: MFUrl([]),
  normal: MFUrl([]),
  texCoord: MFUrl([]),
  texCoord1: MFUrl([]),
  texCoord2: MFUrl([]),
  texCoord3: MFUrl([]),
  color: MFUrl([]),
  data: SFString(""),
  attrib: MFUrl([]),
};

const geometryFields = {
  ...prioritized,
  ...patchFields,
  solid: SFBool(true),
  /** False: the front of triangles is clockwise. */
  ccw: SFBool(true),
  lit: SFBool(true),
  /** Maps the vertices; read on every geometry node. */
  operators: SFString(""),
  position: SFVec3f([0, 0, 0]),
  size: SFVec3f([1, 1, 1]),
  /** The number of bits of a stored coordinate that are used; 0: all bits of its bytes. */
  positionBits: SFInt32(0),
  texCoordMin: SFVec2f([0, 0]),
  texCoordSize: SFVec2f([1, 1]),
  texCoord1Min: SFVec2f([0, 0]),
  texCoord1Size: SFVec2f([1, 1]),
  texCoord2Min: SFVec2f([0, 0]),
  texCoord2Size: SFVec2f([1, 1]),
  texCoord3Min: SFVec2f([0, 0]),
  texCoord3Size: SFVec2f([1, 1]),
  /** The names of the sets of texture coordinates, which textures state as their mapping. */
  texCoordMapping: MFString([]),
  normalEncoding: SFString("rgb"),
  indexType: SFString("Uint16"),
};

const lightFields = {
  on: SFBool(true),
  color: SFColor([1, 1, 1]),
  intensity: SFFloat(1),
  ambientIntensity: SFFloat(0),
};

const positionedLightFields = {
  location: SFVec3f([0, 0, 0]),
  attenuation: SFVec3f([1, 0, 0]),
  radius: SFFloat(100),
  /** False: it lights only its group's descendants. */
  global: SFBool(true),
};

const backgroundFields = {
  ...bindable,
  skyColor: MFColor([[0, 0, 0]]),
  skyAngle: MFFloat([]),
  groundColor: MFColor([]),
  groundAngle: MFFloat([]),
  transparency: SFFloat(0),
};

const fogFields = {
  color: SFColor([1, 1, 1]),
  fogType: SFString("LINEAR"),
  /** 0: no fog. */
  visibilityRange: SFFloat(0),
};

const transformFields = {
  ...prioritized,
  ...boundedObject,
  ...visibleObject,
  translation: SFVec3f([0, 0, 0]),
  rotation: SFRotation([0, 0, 1, 0]),
  scale: SFVec3f([1, 1, 1]),
  center: SFVec3f([0, 0, 0]),
  scaleOrientation: SFRotation([0, 0, 1, 0]),
};

export const nodeFields = {
  X3D: {
    /** Weights of file contents, for the order of requests. */
    chunkPriority: SFString(""),
  },
  NavigationInfo: {
    ...bindable,
    type: MFString(["EXAMINE", "ANY"]),
    headlight: SFBool(true),
    /** Default: depends on the size of the scene. */
    speed: optional(SFFloat(1)),
    avatarSize: MFFloat([0.25, 1.6, 0.75]),
    transitionType: MFString(["LINEAR"]),
    transitionTime: SFFloat(1),
  },
  Background: {
    ...backgroundFields,
    frontUrl: MFUrl([]),
    backUrl: MFUrl([]),
    leftUrl: MFUrl([]),
    rightUrl: MFUrl([]),
    topUrl: MFUrl([]),
    bottomUrl: MFUrl([]),
  },
  TextureBackground: backgroundFields,
  ClipPlane: { enabled: SFBool(true), plane: SFVec4f([0, 1, 0, 0]) },
  Fog: { ...bindable, ...fogFields },
  LocalFog: { ...fogFields, enabled: SFBool(true) },
  Viewpoint: {
    ...bindable,
    description: SFString(""),
    position: SFVec3f([0, 0, 10]),
    orientation: SFRotation([0, 0, 1, 0]),
    fieldOfView: SFFloat(0.7854),
    centerOfRotation: SFVec3f([0, 0, 0]),
  },
  OrthoViewpoint: {
    ...bindable,
    description: SFString(""),
    position: SFVec3f([0, 0, 10]),
    orientation: SFRotation([0, 0, 1, 0]),
    fieldOfView: MFFloat([-1, -1, 1, 1]),
    centerOfRotation: SFVec3f([0, 0, 0]),
  },
  DirectionalLight: { ...lightFields, global: SFBool(false), direction: SFVec3f([0, 0, -1]) },
  PointLight: { ...lightFields, ...positionedLightFields },
  SpotLight: {
    ...lightFields,
    ...positionedLightFields,
    direction: SFVec3f([0, 0, -1]),
    beamWidth: SFFloat(0.7854),
    cutOffAngle: SFFloat(1.5708),
  },
  EnvironmentLight: {
    ...lightFields,
    global: SFBool(false),
    rotation: SFRotation([0, 0, 1, 0]),
    /** Nine spherical harmonics of the light that falls on a surface, by the direction of its normal. */
    diffuseCoefficients: MFFloat([]),
  },
  Group: { ...prioritized, ...boundedObject, ...visibleObject },
  Anchor: {
    ...prioritized,
    ...boundedObject,
    ...visibleObject,
    url: MFUrl([]),
    description: SFString(""),
    parameter: MFString([]),
  },
  Billboard: { ...prioritized, ...boundedObject, ...visibleObject, axisOfRotation: SFVec3f([0, 1, 0]) },
  LOD: { ...prioritized, ...boundedObject, ...visibleObject, center: SFVec3f([0, 0, 0]), range: MFFloat([]) },
  Inline: { ...prioritized, ...boundedObject, ...visibleObject, load: SFBool(true), url: MFUrl([]) },
  Switch: { ...prioritized, ...boundedObject, ...visibleObject, whichChoice: SFInt32(-1) },
  Transform: transformFields,
  HAnimJoint: transformFields,
  HAnimSite: transformFields,
  HAnimHumanoid: {
    ...transformFields,
    /** From the coordinates of its shapes, as they were modelled, to those of each joint. */
    inverseBindMatrices: MFMatrix4f([]),
  },
  HAnimDisplacer: { name: SFString(""), weight: SFFloat(0) },
  Shape: {
    ...prioritized,
    ...boundedObject,
    ...visibleObject,
    isPickable: SFBool(true),
    /** `DEF#N`: the geometry is patch N of the file of the geometry node DEF. */
    patch: SFString(""),
    /** The name of the vertex attribute whose values color the shape. */
    colorBy: SFString(""),
    colorMap: ColorMap("viridis"),
    /** Default: the range of the attribute's values. */
    colorRange: optional(SFVec2f([0, 1])),
  },
  FloatVertexAttribute: {
    name: SFString(""),
    numComponents: SFInt32(4),
    valueBits: SFInt32(16),
    valueMin: MFFloat([]),
    valueSize: MFFloat([]),
  },
  Material: {
    diffuseColor: SFColor([0.8, 0.8, 0.8]),
    specularColor: SFColor([0, 0, 0]),
    emissiveColor: SFColor([0, 0, 0]),
    ambientIntensity: SFFloat(0.2),
    shininess: SFFloat(0.2),
    transparency: SFFloat(0),
    normalScale: SFFloat(1),
    occlusionStrength: SFFloat(1),
  },
  PhysicalMaterial: {
    baseColor: SFColor([1, 1, 1]),
    metallic: SFFloat(1),
    roughness: SFFloat(1),
    emissiveColor: SFColor([0, 0, 0]),
    transparency: SFFloat(0),
    normalScale: SFFloat(1),
    occlusionStrength: SFFloat(1),
  },
  AnisotropyMaterialExtension: {
    anisotropyStrength: SFFloat(0),
    anisotropyRotation: SFFloat(0),
  },
  ClearcoatMaterialExtension: {
    clearcoat: SFFloat(0),
    clearcoatRoughness: SFFloat(0),
  },
  DispersionMaterialExtension: { dispersion: SFFloat(0) },
  EmissiveStrengthMaterialExtension: { emissiveStrength: SFFloat(1) },
  IORMaterialExtension: { indexOfRefraction: SFFloat(1.5) },
  IridescenceMaterialExtension: {
    iridescence: SFFloat(0),
    iridescenceIndexOfRefraction: SFFloat(1.3),
    iridescenceThicknessMinimum: SFFloat(100),
    iridescenceThicknessMaximum: SFFloat(400),
  },
  SheenMaterialExtension: {
    sheenColor: SFColor([0, 0, 0]),
    sheenRoughness: SFFloat(0),
  },
  SpecularMaterialExtension: {
    specular: SFFloat(1),
    specularColor: SFColor([1, 1, 1]),
  },
  TransmissionMaterialExtension: { transmission: SFFloat(0) },
  VolumeMaterialExtension: {
    thickness: SFFloat(0),
    attenuationDistance: SFFloat(1000000),
    attenuationColor: SFColor([1, 1, 1]),
  },
  UnlitMaterial: {
    emissiveColor: SFColor([1, 1, 1]),
    transparency: SFFloat(0),
  },
  Appearance: { alphaMode: SFString("AUTO"), alphaCutoff: SFFloat(0.5) },
  TextureProperties: {
    boundaryModeS: SFString("REPEAT"),
    boundaryModeT: SFString("REPEAT"),
    magnificationFilter: SFString("DEFAULT"),
    minificationFilter: SFString("DEFAULT"),
    anisotropicDegree: SFFloat(1),
  },
  TextureTransform: {
    translation: SFVec2f([0, 0]),
    rotation: SFFloat(0),
    scale: SFVec2f([1, 1]),
    center: SFVec2f([0, 0]),
  },
  LineProperties: { applied: SFBool(true), linetype: SFInt32(1), linewidthScaleFactor: SFFloat(0) },
  PointProperties: {
    pointSizeScaleFactor: SFFloat(1),
    /** Default: no bound. With X3D's defaults, 1 and 1, the scale factor would have no effect. */
    pointSizeMinValue: optional(SFFloat(1)),
    pointSizeMaxValue: optional(SFFloat(1)),
    attenuation: SFVec3f([1, 0, 0]),
  },
  ImageGeometry: {
    ...geometryFields,
    numColorComponents: SFInt32(3),
    /** Bits of a number of octahedral and spherical normals: 8, or 16 in one RGBA image. */
    normalBits: SFInt32(0),
    /** Bits of texture coordinates: 8, 16 in one RGBA image, or 24 in two. */
    texCoordBits: SFInt32(0),
    decode: SFString("auto"),
    profile: SFString("classic"),
    base: SFString(""),
    levels: SFString(""),
    /** With levels: the set of texture coordinates of the groups' own images; 0: they have none. */
    chips: SFInt32(0),
    implicitMeshMode: SFString("auto"),
    /** The paper's name for implicitMeshSize. */
    implicitMeshCount: optional(SFVec2f([256, 256])),
    /** Not used: the distance of a geometry image from the surface that it was sampled from. */
    surfaceDistance: optional(SFVec2f([0, 0])),
    /** Live streams: the picture stands still. */
    paused: SFBool(false),
    /** Live streams: the largest number of frames per second; 0: all. */
    rate: SFFloat(0),
  },
  BinaryGeometry: {
    ...geometryFields,
    rgbaColors: SFBool(false),
    /** False: faces are shaded by their slope, and normals are not read. */
    normalPerVertex: SFBool(true),
    compressed: SFBool(false),
    normalAsSphericalCoordinates: SFBool(false),
    coordType: SFString("Float32"),
    normalType: SFString("Float32"),
    texCoordType: SFString("Float32"),
    texCoord1Type: SFString("Float32"),
    texCoord2Type: SFString("Float32"),
    texCoord3Type: SFString("Float32"),
    colorType: SFString("Float32"),
  },
  Box: { size: SFVec3f([2, 2, 2]) },
  Sphere: { radius: SFFloat(1) },
  Cylinder: { radius: SFFloat(1), height: SFFloat(2), side: SFBool(true), top: SFBool(true), bottom: SFBool(true) },
  Cone: { bottomRadius: SFFloat(1), height: SFFloat(2), side: SFBool(true), bottom: SFBool(true) },
  Arc2D: { startAngle: SFFloat(0), endAngle: SFFloat(1.570796), radius: SFFloat(1) },
  ArcClose2D: {
    closureType: SFString("PIE"),
    startAngle: SFFloat(0),
    endAngle: SFFloat(1.570796),
    radius: SFFloat(1),
    solid: SFBool(false),
  },
  Circle2D: { radius: SFFloat(1) },
  Disk2D: { innerRadius: SFFloat(0), outerRadius: SFFloat(1), solid: SFBool(false) },
  Polyline2D: { lineSegments: MFFloat([]) },
  Polypoint2D: { point: MFFloat([]) },
  Rectangle2D: { size: SFVec2f([2, 2]), solid: SFBool(false) },
  TriangleSet2D: { vertices: MFFloat([]), solid: SFBool(false) },
  /** The fields of all geometry nodes whose vertices are in the document; each node has some of them. */
  InlineGeometry: {
    solid: SFBool(true),
    ccw: SFBool(true),
    convex: SFBool(true),
    creaseAngle: SFFloat(0),
    colorPerVertex: SFBool(true),
    normalPerVertex: SFBool(true),
    coordIndex: MFInt32([]),
    normalIndex: MFInt32([]),
    texCoordIndex: MFInt32([]),
    colorIndex: MFInt32([]),
    index: MFInt32([]),
    stripCount: MFInt32([]),
    fanCount: MFInt32([]),
    vertexCount: MFInt32([]),
  },
  ElevationGrid: {
    xDimension: SFInt32(0),
    zDimension: SFInt32(0),
    xSpacing: SFFloat(1),
    zSpacing: SFFloat(1),
    height: MFFloat([]),
    colorPerVertex: SFBool(true),
    normalPerVertex: SFBool(true),
  },
  Extrusion: {
    crossSection: MFFloat([1, 1, 1, -1, -1, -1, -1, 1, 1, 1]),
    spine: MFFloat([0, 0, 0, 0, 1, 0]),
    scale: MFFloat([1, 1]),
    orientation: MFFloat([0, 0, 1, 0]),
    beginCap: SFBool(true),
    endCap: SFBool(true),
  },
  Text: { string: MFText([]), length: MFFloat([]), maxExtent: SFFloat(0), solid: SFBool(false) },
  FontStyle: {
    family: MFString(["SERIF"]),
    style: SFString("PLAIN"),
    /** An alternative to `style`, which a page's content security policy may forbid. */
    "data-style": SFString(""),
    size: SFFloat(1),
    spacing: SFFloat(1),
    justify: MFString(["BEGIN"]),
    horizontal: SFBool(true),
    leftToRight: SFBool(true),
    topToBottom: SFBool(true),
  },
  Coordinate: { point: MFFloat([]) },
  Normal: { vector: MFFloat([]) },
  TextureCoordinate: { point: MFFloat([]), mapping: SFString("") },
  TextureCoordinateGenerator: { mode: SFString("SPHERE") },
  Color: { color: MFFloat([]) },
  FogCoordinate: { depth: MFFloat([]) },
  GeometryPatch: { ...boundedObject, ...patchFields, recordCount: SFInt32(0), gridOrigin: SFVec2f([0, 0]) },
  ImageTexture: {
    containerField: SFString(""),
    url: MFUrl([]),
    preview: SFString(""),
    repeatS: SFBool(true),
    repeatT: SFBool(true),
  },
  ImageCubeMapTexture: { containerField: SFString(""), url: MFUrl([]), preview: SFString("") },
  GeneratedCubeMapTexture: { containerField: SFString(""), size: SFInt32(128), update: SFString("NONE") },
  ComposedCubeMapTexture: { containerField: SFString("") },
  PixelTexture: { image: SFImage(noPixels), repeatS: SFBool(true), repeatT: SFBool(true) },
} as const;

/** A node's values by field name. */
export type Values<Fields> = {
  readonly [Name in keyof Fields]: Fields[Name] extends Field<infer Value> ? Value : never;
};

/** A problem in the document; a default is used instead of what is written. */
export interface Warning {
  readonly element: SceneElement;
  readonly message: string;
}

/** The node's values: the element's attributes, or the default where one is missing or malformed. */
export function readFields<Fields extends Record<string, Field<unknown>>>(
  element: SceneElement,
  fields: Fields,
  warnings: Warning[],
): Values<Fields> {
  const values: Record<string, unknown> = {};
  const textOf = attributesOf(element);
  for (const [name, field] of Object.entries(fields)) {
    const text = textOf(name);
    const value = text === undefined ? field.defaultValue : field.type.parse(text);
    if (value === undefined && text !== undefined) {
      warnings.push({ element, message: `${name}="${shortened(text)}" is no ${field.type.name}; it counts as absent` });
    }
    values[name] = value ?? field.defaultValue;
  }
  return values as Values<Fields>;
}

/** The beginning of an attribute's text, for messages. */
export function shortened(text: string): string {
  return text.length > 40 ? `${text.slice(0, 40)}…` : text;
}
