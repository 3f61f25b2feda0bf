// Where our picture differs from another runtime's, and why.

/** Pictures whose channels differ by no more than this on average, of 255, are the same. */
export const sameMean = 1;

const otherDiagonal =
  "X3D leaves open along which diagonal a quad is split; X_ITE takes the other. X3DOM's npm package does not have the node";
const otherFonts = "glyphs come from the browser's fonts; X_ITE brings its own fonts";
const noFans = "X3DOM's npm package does not draw it";
const noTexturesInMaterials = "X3DOM does not know X3D 4's textures of materials";
const withoutPi =
  "a light of intensity 1 makes a white surface that faces it white, as with `Material`; X_ITE divides by π. X3DOM does not know the node";

const allLightsAreGlobal = "X3DOM's lights shine on everything, whatever their `global`";

export const explanations: Readonly<Record<string, string>> = {
  "Appearance-alphaMode-MASK": "X3DOM does not know `alphaMode`",
  "DirectionalLight-of-its-group": allLightsAreGlobal,
  ElevationGrid: otherDiagonal,
  "ElevationGrid-ccw": otherDiagonal,
  "ElevationGrid-colorPerFace": otherDiagonal,
  "ElevationGrid-creaseAngle": otherDiagonal,
  "ElevationGrid-texture": otherDiagonal,
  Extrusion: "X3DOM's npm package does not have the node",
  "Extrusion-twist": "X3DOM's npm package does not have the node",
  "FontStyle-family": otherFonts,
  "FontStyle-justify": otherFonts,
  "FontStyle-vertical": `${otherFonts}; X3DOM does not know \`horizontal\``,
  Grouping: "X3DOM shows nothing of a document that has a `StaticGroup`",
  "ImageTexture-colored-material":
    "a texture is multiplied by the diffuse colour (X3D 4); in X3DOM it stands in for it",
  "IndexedFaceSet-creaseAngle-between":
    "edges of up to `creaseAngle` are smooth, others sharp; X3DOM makes all of them smooth",
  IndexedTriangleFanSet: noFans,
  IndexedTriangleStripSet: "X3DOM does not share normals between strips",
  LineProperties: "X3DOM draws all lines one pixel wide",
  "LineProperties-dashed": "X_ITE's line is solid here, X3DOM's one pixel wide as well",
  "Material-diffuseTexture": noTexturesInMaterials,
  "Material-emissiveTexture": noTexturesInMaterials,
  "Material-normalTexture": `green points up in the picture, as in glTF; in X_ITE down. ${noTexturesInMaterials}`,
  MultiTexture: "of several textures the first is shown; the runtimes mix them differently",
  PixelTexture: "X_ITE shows the squares of pictures of few pixels; X3D leaves the filter open",
  "PhysicalMaterial-metallic-0-roughness-0.3": withoutPi,
  "PhysicalMaterial-metallic-0-roughness-1": withoutPi,
  "PhysicalMaterial-metallic-1-roughness-0.4": `${withoutPi}. Metal mirrors a grey room, X_ITE's nothing`,
  "PointLight-of-its-group": allLightsAreGlobal,
  "PointLight-scaled": "what scales a light scales its radius and its falloff; not in X3DOM",
  Text: otherFonts,
  "Text-length": `${otherFonts}. Glyphs are stretched; X_ITE changes the space between them; X3DOM does not support \`length\` and squeezes one string alone`,
  "Text-no-material": `${otherFonts}; in X3DOM MIDDLE is a little higher`,
  TextureTransform: "textures seen small are filtered otherwise",
  "Transform-mirror": "a mirror turns triangles round; X3DOM shows their backs",
  TriangleFanSet: noFans,
  TriangleStripSet: noFans,
  "UnlitMaterial-emissiveTexture": "X3DOM does not know the node",
  UnlitMaterial: "X3DOM does not know the node",
};
