// The MaterialFactory of three.js apps: three.js' own materials, so that the app's lights, shadows,
// tone mapping and colour space apply. The vertex chunk is added to the materials of every pass, so
// that shadows have the shape of the visible surface.

import type { Camera, Material, MeshPhysicalMaterialParameters, Sphere, Texture, WebGLRenderer } from "three";
import {
  Color,
  LinearSRGBColorSpace,
  MeshBasicMaterial,
  MeshDepthMaterial,
  MeshDistanceMaterial,
  MeshPhysicalMaterial,
  MeshStandardMaterial,
  Points,
  SRGBColorSpace,
} from "three";
import type {
  AppearanceDescription,
  MaterialDescription,
  MaterialExtensions,
  TextureRole,
  Vec3,
} from "../document/description.ts";
import { textureRoles } from "../document/description.ts";
import { depthShadingDefine, addDepthShading } from "../render/materials/depthShading.ts";
import { addGlyphField, hasGlyphs, setGlyphDefine } from "../render/materials/glyphField.ts";
import { minAlpha, sideOf } from "../render/materials/materialFactory.ts";
import type { MaterialFactory, MaterialRequest, Shading } from "../render/materials/materialFactory.ts";
import type { SurfaceTextures } from "../render/materials/surfaceTextures.ts";
import { lateValues } from "../render/materials/lateValues.ts";
import { primitiveDefinesOf, addPrimitiveChunks } from "../render/points/roundPoints.ts";
import { editShaders } from "../render/shaders/editShaders.ts";
import { addVertexReading, readVertexKey } from "../render/shaders/vertexChunk.ts";
import { needsViewport, srgbColorsDefine, vertexDefinesOf } from "../render/shaders/vertexFormat.ts";
import { followViewport } from "../render/shaders/followViewport.ts";

/**
 * Makes the material of a shape from X3D's. `shading`: "smooth" by normals, "flat" by the surface's slope, "unlit" for
 * points and lines, "distance" for points that stand in for a surface. May return any built-in material of three.js but
 * ShaderMaterials; each call must make a new one. Called for each stage of a patch.
 */
export type MaterialMaker = (material: MaterialDescription, shading: Shading) => Material;

/**
 * X3D's and glTF's physical material as three.js' standard material; X3D's Phong material as an approximation with a
 * roughness of equal highlight width.
 */
export function standardMaterialOf(description: MaterialDescription, shading: Shading): Material {
  const opacity = 1 - description.transparency;
  const transparent = description.transparency > 0;
  const colorSpace = description.kind === "physical" ? LinearSRGBColorSpace : SRGBColorSpace;
  const emissive = new Color().setRGB(...description.emissiveColor, colorSpace);
  const color =
    description.kind === "unlit"
      ? emissive
      : new Color().setRGB(
          ...(description.kind === "physical" ? description.baseColor : description.diffuseColor),
          colorSpace,
        );
  if (shading === "unlit" || shading === "distance" || description.kind === "unlit") {
    return new MeshBasicMaterial({ color: emissive.getHex() === 0 ? color : emissive, opacity, transparent });
  }
  if (description.kind === "physical" && description.extensions)
    return physicalMaterialOf(description, description.extensions, { color, opacity, transparent, emissive });
  return new MeshStandardMaterial({
    color,
    opacity,
    transparent,
    emissive,
    ...(description.kind === "physical"
      ? { roughness: description.roughness, metalness: description.metallic }
      : // From Blinn's exponent, Walter et al. 2007.
        { roughness: Math.sqrt(2 / (description.shininess * 128 + 2)), metalness: 0 }),
  });
}

/** glTF's material with extensions. */
function physicalMaterialOf(
  { roughness, metallic }: MaterialDescription & { kind: "physical" },
  extensions: MaterialExtensions,
  common: MeshPhysicalMaterialParameters,
): MeshPhysicalMaterial {
  const linear = (color: Vec3) => new Color().setRGB(...color, LinearSRGBColorSpace);
  const { sheenColor } = extensions;
  return new MeshPhysicalMaterial({
    ...common,
    roughness,
    metalness: metallic,
    anisotropy: extensions.anisotropyStrength,
    anisotropyRotation: extensions.anisotropyRotation,
    clearcoat: extensions.clearcoat,
    clearcoatRoughness: extensions.clearcoatRoughness,
    dispersion: extensions.dispersion,
    ior: extensions.indexOfRefraction,
    iridescence: extensions.iridescence,
    iridescenceIOR: extensions.iridescenceIndexOfRefraction,
    iridescenceThicknessRange: [extensions.iridescenceThicknessMinimum, extensions.iridescenceThicknessMaximum],
    sheen: sheenColor.some((channel) => channel > 0) ? 1 : 0,
    sheenColor: linear(sheenColor),
    sheenRoughness: extensions.sheenRoughness,
    specularIntensity: extensions.specular,
    specularColor: linear(extensions.specularColor),
    transmission: extensions.transmission,
    thickness: extensions.thickness,
    attenuationDistance: extensions.attenuationDistance,
    attenuationColor: linear(extensions.attenuationColor),
  });
}

/** Properties of the scene's Object3D that materials need. */
export interface SceneShadowOptions {
  readonly castShadow: boolean;
  readonly receiveShadow: boolean;
  /** Around the scene, in the app's world coordinates. */
  readonly sphere: Sphere;
}

export function makeStandardMaterials(makeMaterial: MaterialMaker, shadowOptions: SceneShadowOptions): MaterialFactory {
  const shadowMaterials = new WeakMap<Material, ShadowMaterials>();
  return {
    batching: undefined, // three.js' Raycaster, and passes with their own materials, need one object per instance
    makeMaterial(request, appearance, surfaceTextures) {
      const material = makeMaterial(appearance.material, request.shading);
      material.side = sideOf(request);
      if (needsViewport(request)) followViewport(material, request.shared.viewport);
      material.vertexColors = request.colors !== "none";
      if (request.colors === "rgba") material.transparent = true;
      if ("flatShading" in material && request.shading === "flat") material.flatShading = true;
      // Vertex colours replace the diffuse colour, as in X3D.
      if (material.vertexColors && "color" in material && material.color instanceof Color) material.color.set(0xffffff);
      const shadows = shadowMaterialsOf(material, request);
      shadowMaterials.set(material, shadows);
      setTextureMaps(material, shadows, appearance, surfaceTextures);
      return addVertexReadingTo(
        material,
        request,
        request.shading === "smooth" && !("flatShading" in material && material.flatShading === true),
      );
    },
    // The document does not change; only textures do.
    applyAppearance: (material, appearance, _, surfaceTextures) => {
      setTextureMaps(material, shadowMaterials.get(material), appearance, surfaceTextures);
    },
    prepareObject(object, request, material) {
      object.castShadow = shadowOptions.castShadow;
      object.receiveShadow = shadowOptions.receiveShadow;
      const { depth, distance } = shadowMaterials.get(material) ?? {};
      object.customDepthMaterial = depth;
      object.customDistanceMaterial = distance;
      // There are no vertices in JavaScript to intersect: three.js' own `raycast` would throw.
      if (request.isFromImages || request.wideLineStep > 0) object.raycast = () => undefined;
      if (object instanceof Points || request.wideLineStep > 0)
        object.onBeforeRender = (renderer, _, camera) => {
          updateSharedUniforms(renderer, camera, request);
        };
    },
  };

  /**
   * Sets the pixel ratio, by which points have their size in CSS pixels, and the range of depth shading, which spans
   * the scene.
   */
  function updateSharedUniforms(renderer: WebGLRenderer, camera: Camera, { shared }: MaterialRequest): void {
    shared.pixelRatio.value = renderer.getPixelRatio();
    const { center, radius } = shadowOptions.sphere;
    const depth = -center.applyMatrix4(camera.matrixWorldInverse).z;
    shared.depthRange.value.set(Math.max(depth - radius, 0), depth + radius);
  }
}

/** The maps of three.js' materials for each role; each is multiplied with the field beside it, as in X3D. */
const mapNames: Readonly<Record<TextureRole, readonly string[]>> = {
  color: ["map"],
  emissive: ["emissiveMap"],
  metallicRoughness: ["roughnessMap", "metalnessMap"],
  normal: ["normalMap"],
  occlusion: ["aoMap"],
  ambient: [],
  specular: ["specularMap"],
  shininess: [],
  anisotropy: ["anisotropyMap"],
  clearcoat: ["clearcoatMap"],
  clearcoatRoughness: ["clearcoatRoughnessMap"],
  clearcoatNormal: ["clearcoatNormalMap"],
  iridescence: ["iridescenceMap"],
  iridescenceThickness: ["iridescenceThicknessMap"],
  sheenColor: ["sheenColorMap"],
  sheenRoughness: ["sheenRoughnessMap"],
  specularStrength: ["specularIntensityMap"],
  specularColor: ["specularColorMap"],
  transmission: ["transmissionMap"],
  thickness: ["thicknessMap"],
};

/** Applies textures. Maps that the app has set stay until the scene's textures replace them. */
function setTextureMaps(
  material: Material,
  shadows: ShadowMaterials | undefined,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
): void {
  const { alpha, material: description } = appearance;
  setGlyphDefine(material, appearance);
  for (const role of textureRoles) {
    const isUsed = role === "color" || description.kind !== "unlit";
    for (const mapName of mapNames[role])
      if (isUsed) setTextureMap(material, mapName, surfaceTextures.get(role)?.texture);
  }
  if (material instanceof MeshStandardMaterial && description.kind !== "unlit") {
    material.normalScale.set(description.normalScale, description.normalScale);
    material.aoMapIntensity = description.occlusionStrength;
  }
  const color = surfaceTextures.get("color");
  if (color === undefined) return;
  if (alpha.mode === "BLEND" || (alpha.mode === "AUTO" && color.hasAlpha)) {
    material.transparent = true;
    material.alphaTest ||= minAlpha;
  }
  const areGlyphs = hasGlyphs(appearance);
  if (alpha.mode !== "MASK" && !areGlyphs) return;
  // Shadow materials have the same holes. The outline of a glyph is at half of its distance field.
  for (const tested of [areGlyphs ? undefined : material, shadows?.depth, shadows?.distance]) {
    if (tested === undefined) continue;
    tested.alphaTest = areGlyphs ? 0.5 : alpha.cutoff;
    setTextureMap(tested, "map", color.texture);
  }
}

/** Sets a map of a material. `texture` undefined: removes a texture of the scene, but not one of the app. */
function setTextureMap(material: Material, mapName: string, texture: Texture | undefined): void {
  if (!(mapName in material)) return;
  const maps = material as unknown as Record<string, Texture | null>;
  const sceneTextures = (material.userData.imgeoMaps ??= {}) as Record<string, Texture>;
  const before = maps[mapName] ?? null;
  if (before === texture || (texture === undefined && (before === null || before !== sceneTextures[mapName]))) return;
  maps[mapName] = texture ?? null;
  if (texture) sceneTextures[mapName] = texture;
  if ((before === null) !== (texture === undefined)) material.needsUpdate = true;
}

interface ShadowMaterials {
  readonly depth: Material;
  readonly distance: Material;
}

/**
 * The materials for shadows of directional and spot lights (`depth`) and of point lights (`distance`). They are
 * disposed of with `material`.
 */
function shadowMaterialsOf(material: Material, request: MaterialRequest): ShadowMaterials {
  const depth = addVertexReadingTo(new MeshDepthMaterial(), request, false);
  const distance = addVertexReadingTo(new MeshDistanceMaterial(), request, false);
  const onDispose = () => {
    material.removeEventListener("dispose", onDispose);
    depth.dispose();
    distance.dispose();
  };
  material.addEventListener("dispose", onDispose);
  return { depth, distance };
}

/** Adds the vertex chunk to a material, and keeps its own `onBeforeCompile`. */
function addVertexReadingTo<Any extends Material>(material: Any, request: MaterialRequest, readsNormals: boolean): Any {
  const ownOnBeforeCompile = material.onBeforeCompile.bind(material);
  const ownKey = material.customProgramCacheKey();
  material.defines = {
    ...material.defines,
    ...vertexDefinesOf(request, readsNormals),
    ...primitiveDefinesOf(request.primitive),
    [srgbColorsDefine]: "",
    ...(request.shading === "distance" && { [depthShadingDefine]: "" }),
    ...request.valueDefines,
  };
  material.onBeforeCompile = (shader, renderer) => {
    ownOnBeforeCompile(shader, renderer);
    Object.assign(shader.uniforms, request.uniforms, { depthRange: request.shared.depthRange });
    editShaders(shader, readVertexKey(), (texts) => {
      addVertexReading(texts);
      addPrimitiveChunks(texts);
      addDepthShading(texts);
      lateValues.added?.addColors(texts);
      addGlyphField(texts);
    });
  };
  material.customProgramCacheKey = () => `imgeo ${ownKey}`;
  return material;
}
