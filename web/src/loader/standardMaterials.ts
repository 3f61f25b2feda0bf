// How a scene looks in somebody's own three.js app: with three's materials, so
// that the app's lights, shadows, tone mapping and colour space hold for it as
// for everything else there. Only where vertices come from is ours, and it is
// the same in every pass: what casts a shadow is what is seen.

import type { Camera, Material, Sphere, Texture, WebGLRenderer } from "three";
import {
  Color,
  DoubleSide,
  FrontSide,
  LinearSRGBColorSpace,
  MeshBasicMaterial,
  MeshDepthMaterial,
  MeshDistanceMaterial,
  MeshStandardMaterial,
  Points,
  SRGBColorSpace,
} from "three";
import type { AppearanceDescription, MaterialDescription, TextureRole } from "../document/description.ts";
import { textureRoles } from "../document/description.ts";
import { depthShadingDefine, addDepthShading } from "../render/materials/depthShading.ts";
import { addGlyphField, hasGlyphs, setGlyphDefine } from "../render/materials/glyphField.ts";
import { minAlpha } from "../render/materials/materialFactory.ts";
import type { MaterialFactory, MaterialRequest, Shading } from "../render/materials/materialFactory.ts";
import type { SurfaceTextures } from "../render/materials/surfaceTextures.ts";
import { addValueColors } from "../render/materials/valueColors.ts";
import { primitiveDefinesOf, addRoundPoints } from "../render/points/roundPoints.ts";
import { addVertexReading } from "../render/shaders/vertexChunk.ts";
import { vertexDefinesOf } from "../render/shaders/vertexFormat.ts";
import { srgbColorsDefine } from "../render/shaders/vertexFormat.ts";
import { followViewport } from "../render/shaders/wideLineChunk.ts";

/**
 * Makes the material of a shape from X3D's. `shading` says what there is to shade:
 * "smooth" by normals, "flat" by slope, "unlit" and "distance" are points and
 * lines. Any built-in material of three.js but its ShaderMaterials will do; each
 * call must make a new one. Called again for each stage of a patch.
 */
export type MaterialMaker = (material: MaterialDescription, shading: Shading) => Material;

/** X3D's and glTF's physical material is three's own; of X3D's other one, a reading with its shininess as roughness, by the width of the highlight. */
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
  return new MeshStandardMaterial({
    color,
    opacity,
    transparent,
    emissive,
    ...(description.kind === "physical"
      ? { roughness: description.roughness, metalness: description.metallic }
      : // As of Blinn's exponent, Walter et al. 2007.
        { roughness: Math.sqrt(2 / (description.shininess * 128 + 2)), metalness: 0 }),
  });
}

/** What a scene is in the app that it is hung into. */
export interface SceneShadowOptions {
  readonly castShadow: boolean;
  readonly receiveShadow: boolean;
  /** Around the scene, in the app's world. */
  readonly sphere: Sphere;
}

export function makeStandardMaterials(makeMaterial: MaterialMaker, surroundings: SceneShadowOptions): MaterialFactory {
  const shadowMaterials = new WeakMap<Material, ShadowMaterials>();
  return {
    batching: undefined, // three's Raycaster, and passes with materials of their own, want an object for each place
    makeMaterial(request, appearance, surfaceTextures) {
      const material = makeMaterial(appearance.material, request.shading);
      material.side = request.solid && request.wideLineStep === 0 ? FrontSide : DoubleSide;
      if (request.wideLineStep > 0) followViewport(material, request.shared.viewport);
      material.vertexColors = request.colors !== "none";
      if (request.colors === "rgba") material.transparent = true;
      if ("flatShading" in material && request.shading === "flat") material.flatShading = true;
      // Colours of vertices stand in for the diffuse colour, as X3D has it.
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
    // The document is read once, so only its surfaceTextures come later.
    applyAppearance: (material, appearance, _, surfaceTextures) => {
      setTextureMaps(material, shadowMaterials.get(material), appearance, surfaceTextures);
    },
    prepareObject(object, request, material) {
      object.castShadow = surroundings.castShadow;
      object.receiveShadow = surroundings.receiveShadow;
      const { depth, distance } = shadowMaterials.get(material) ?? {};
      object.customDepthMaterial = depth;
      object.customDistanceMaterial = distance;
      // There are no vertices in JavaScript for a ray, and three does not expect that.
      if (request.isFromImages || request.wideLineStep > 0) object.raycast = () => undefined;
      if (object instanceof Points || request.wideLineStep > 0)
        object.onBeforeRender = (renderer, _, camera) => {
          measure(renderer, camera, request);
        };
    },
  };

  /** Points are as large in every app, and those that stand for a surface are darker the farther they are in the scene. */
  function measure(renderer: WebGLRenderer, camera: Camera, { shared }: MaterialRequest): void {
    shared.pixelRatio.value = renderer.getPixelRatio();
    const { center, radius } = surroundings.sphere;
    const ahead = -center.applyMatrix4(camera.matrixWorldInverse).z;
    shared.depthRange.value.set(Math.max(ahead - radius, 0), ahead + radius);
  }
}

/** By role, the maps of three's materials that take it; what is there of each is multiplied by the number beside it, as in X3D. */
const slots: Readonly<Record<TextureRole, readonly string[]>> = {
  color: ["map"],
  emissive: ["emissiveMap"],
  metallicRoughness: ["roughnessMap", "metalnessMap"],
  normal: ["normalMap"],
  occlusion: ["aoMap"],
  ambient: [],
  specular: ["specularMap"],
  shininess: [],
};

/** Over the material's own colour. A material with maps of the app's keeps them until there are others. */
function setTextureMaps(
  material: Material,
  shadows: ShadowMaterials | undefined,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
): void {
  const { alpha, material: description } = appearance;
  setGlyphDefine(material, appearance);
  for (const role of textureRoles) {
    const isMain = role === "color" || description.kind !== "unlit";
    for (const slot of slots[role]) if (isMain) setTextureMap(material, slot, surfaceTextures.get(role)?.texture);
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
  // Holes let light through; letters have their edges in the middle of their field.
  for (const drawn of [areGlyphs ? undefined : material, shadows?.depth, shadows?.distance]) {
    if (drawn === undefined) continue;
    drawn.alphaTest = areGlyphs ? 0.5 : alpha.cutoff;
    setTextureMap(drawn, "map", color.texture);
  }
}

/** Undefined: none of ours any more. */
function setTextureMap(material: Material, slot: string, texture: Texture | undefined): void {
  if (!(slot in material)) return;
  const maps = material as unknown as Record<string, Texture | null>;
  const laid = (material.userData.imgeoMaps ??= {}) as Record<string, Texture>;
  const before = maps[slot] ?? null;
  if (before === texture || (texture === undefined && (before === null || before !== laid[slot]))) return;
  maps[slot] = texture ?? null;
  if (texture) laid[slot] = texture;
  if ((before === null) !== (texture === undefined)) material.needsUpdate = true;
}

interface ShadowMaterials {
  readonly depth: Material;
  readonly distance: Material;
}

/** For shadows of directional lights and spots, and for those of points; they go with the material that is seen. */
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

/** Lets a material draw vertices of this form, whatever it does besides. */
function addVertexReadingTo<Any extends Material>(material: Any, request: MaterialRequest, readsNormals: boolean): Any {
  const own = material.onBeforeCompile.bind(material);
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
    own(shader, renderer);
    Object.assign(shader.uniforms, request.uniforms, { depthRange: request.shared.depthRange });
    addVertexReading(shader);
    addRoundPoints(shader);
    addDepthShading(shader);
    addValueColors(shader);
    addGlyphField(shader);
  };
  material.customProgramCacheKey = () => `imgeo ${ownKey}`;
  return material;
}
