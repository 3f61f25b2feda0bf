// The fields of geometry nodes, and of the nodes in them: a part of the table in nodes.ts.

import { boundedObject, prioritized } from "./commonFields.ts";
import {
  MFFloat,
  MFInt32,
  MFString,
  MFText,
  MFUrl,
  optional,
  SFBool,
  SFFloat,
  SFInt32,
  SFString,
  SFVec2f,
  SFVec3f,
} from "./fieldTypes.ts";

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

export const geometryNodes = {
  FloatVertexAttribute: {
    name: SFString(""),
    numComponents: SFInt32(4),
    valueBits: SFInt32(16),
    valueMin: MFFloat([]),
    valueSize: MFFloat([]),
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
} as const;
