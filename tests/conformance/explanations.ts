// Explains for each document why imgeo's picture differs from those of other runtimes.

/** Pictures with a mean difference of up to this, of 255, count as equal. */
export const maxEqualMean = 1;

const otherDiagonal =
  "X3D does not specify the diagonal along which a quad is split; X_ITE uses the other one. X3DOM's npm package lacks the node";
const otherFonts = "glyphs come from the browser's fonts; X_ITE brings its own fonts";
const noNode = "X3DOM's npm package lacks the node";
const noFans = "X3DOM's npm package does not draw the node";
const noTexturesInMaterials = "X3DOM does not support X3D 4's textures of materials";
const allEdgesAreSmooth =
  "edges with angles up to `creaseAngle` are smooth, others sharp; X3DOM makes all edges smooth";
const withoutPi =
  "a light of intensity 1 makes a white surface that faces it white, as with `Material`; X_ITE divides by π. X3DOM lacks the node";

const allLightsAreGlobal = "X3DOM's lights ignore `global` and light everything";

export const explanations: Readonly<Record<string, string>> = {
  "Animation-skin": "X3DOM does not move the points of skins",
  "Animation-spline": "X3DOM lacks `SplineScalarInterpolator`",
  "Animation-squad-ease": "X3DOM lacks `SquadOrientationInterpolator` and `EaseInEaseOut`",
  "Appearance-alphaMode-MASK": "X3DOM does not support `alphaMode`",
  "Background-pictures": "X3DOM exchanges front and back and mirrors their pictures",
  "Background-rotated": "X3DOM's backgrounds do not turn with their groups",
  ClipPlane: "X_ITE clips the background, too",
  "DirectionalLight-of-its-group": allLightsAreGlobal,
  ElevationGrid: otherDiagonal,
  "ElevationGrid-ccw": otherDiagonal,
  "ElevationGrid-colorPerFace": otherDiagonal,
  "ElevationGrid-creaseAngle": otherDiagonal,
  "ElevationGrid-texture": otherDiagonal,
  Extrusion: "X3DOM's npm package lacks the node",
  "Extrusion-twist": "X3DOM's npm package lacks the node",
  "Fog-exponential": "X3DOM does not scale `visibilityRange` with the node",
  FogCoordinate: "X3DOM lacks the node",
  "FontStyle-family": otherFonts,
  "FontStyle-justify": otherFonts,
  "FontStyle-vertical": `${otherFonts}; X3DOM does not support \`horizontal\``,
  "Geometry2D-lines": noNode,
  "Geometry2D-surfaces": noNode,
  "Geometry2D-texture": noNode,
  Grouping: "X3DOM does not display a document that contains a `StaticGroup`",
  "ImageTexture-colored-material":
    "the texture is multiplied by the diffuse colour (X3D 4); in X3DOM it replaces the diffuse colour",
  "IndexedFaceSet-creaseAngle-between": allEdgesAreSmooth,
  IndexedQuadSet: noNode,
  IndexedTriangleFanSet: noFans,
  IndexedTriangleStripSet: "X3DOM does not share normals between strips",
  LineProperties: "X3DOM draws all lines one pixel wide",
  "LineProperties-dashed": "X_ITE draws a solid line here; X3DOM draws all lines one pixel wide",
  LocalFog: "X3DOM lacks the node",
  "Material-diffuseTexture": noTexturesInMaterials,
  "Material-emissiveTexture": noTexturesInMaterials,
  "Material-normalTexture": `green points up in the normal map, as in glTF; in X_ITE it points down. ${noTexturesInMaterials}`,
  MultiTexture: "imgeo displays the first of several textures; the other runtimes blend them in different ways",
  "Nurbs-ship": noNode,
  NurbsCurve: noNode,
  NurbsPatchSurface: noNode,
  "NurbsPatchSurface-sphere": noNode,
  "NurbsPatchSurface-texture": noNode,
  NurbsSweptSurface: noNode,
  NurbsSwungSurface: noNode,
  NurbsTrimmedSurface: noNode,
  PixelTexture: "X_ITE uses nearest filtering for small images; X3D does not specify the filter",
  "PhysicalMaterial-metallic-0-roughness-0.3": withoutPi,
  "PhysicalMaterial-metallic-0-roughness-1": withoutPi,
  "PhysicalMaterial-metallic-1-roughness-0.4": `${withoutPi}. Metal reflects a grey room in imgeo and nothing in X_ITE`,
  "PointLight-of-its-group": allLightsAreGlobal,
  "PointLight-scaled": "scaling a light scales its radius and its attenuation; not in X3DOM",
  QuadSet: noNode,
  Text: otherFonts,
  "Text-length": `${otherFonts}. Glyphs are stretched; X_ITE changes the space between them; X3DOM does not support \`length\` and compresses only one string`,
  "Text-no-material": `${otherFonts}; in X3DOM MIDDLE is slightly higher`,
  "TextureCoordinateGenerator-COORD": "in X3DOM the texture replaces the diffuse colour",
  "TextureCoordinateGenerator-SPHERE-LOCAL":
    "computed from the vertices' normals; X_ITE computes it from the normal of each pixel. In X3DOM the texture replaces the diffuse colour",
  TextureBackground: "X3DOM lacks the node",
  "TextureCoordinate-mapping": noTexturesInMaterials,
  TextureTransform: "minified textures are filtered differently",
  "TextureTransform-mapping": noTexturesInMaterials,
  "Transform-mirror":
    "a mirroring transform reverses the orientation of triangles, which imgeo corrects; X3DOM displays their backs",
  TriangleFanSet: noFans,
  TriangleStripSet: noFans,
  "UnlitMaterial-emissiveTexture": "X3DOM lacks the node",
  UnlitMaterial: "X3DOM lacks the node",
  Vrml1: allEdgesAreSmooth,
};
