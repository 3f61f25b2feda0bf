// PhysicalMaterials with extensions (lighting/extendedLighting.ts) in pages.

import type { IUniform, Material, Texture, WebGLRenderer } from "three";
import { FramebufferTexture, LinearFilter, LinearMipmapLinearFilter, Vector2 } from "three";
import type { MaterialDescription, MaterialExtensions } from "../../document/description.ts";
import {
  extendedDefine,
  extendedLighting,
  extendedSurface,
  extensionUniforms,
  transmissionChunk,
} from "../../lighting/extendedLighting.ts";
import { instancesDefine } from "../shaders/instanceRecord.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";
import { extraMapDefine, extraTexel, extraUv } from "../shaders/texCoords.ts";
import { setDefine } from "./defines.ts";

export type ExtensionUniforms = Record<keyof typeof extensionUniforms, IUniform>;

export function makeExtensionUniforms(): ExtensionUniforms {
  return Object.fromEntries(Object.keys(extensionUniforms).map((name) => [name, { value: 0 }])) as ExtensionUniforms;
}

/** The extensions of a lit material; undefined: it has none. */
export function extensionsOf(description: MaterialDescription): MaterialExtensions | undefined {
  return description.kind === "physical" ? description.extensions : undefined;
}

/** Whether light from behind shines through: the surface is drawn after what is opaque. */
export function isTransmissive(description: MaterialDescription): boolean {
  return (extensionsOf(description)?.transmission ?? 0) > 0;
}

/** Updates a material and its uniforms; three.js compiles another program if it gets or loses extensions. */
export function applyExtensions(
  material: Material,
  description: MaterialDescription,
  uniforms: ExtensionUniforms,
  backdrop: Backdrop,
): void {
  const extensions = extensionsOf(description);
  setDefine(material, extendedDefine, extensions !== undefined);
  const captures = isTransmissive(description);
  material.onBeforeRender = captures
    ? (renderer) => {
        backdrop.capture(renderer);
      }
    : () => undefined;
  if (extensions === undefined) return;
  const { specular, ...others } = extensions;
  for (const [name, value] of Object.entries({ ...others, reflectionStrength: specular }))
    uniforms[name as keyof ExtensionUniforms].value = value;
}

const surfaceChunk = extendedSurface(
  (role, use) => `
#ifdef ${extraMapDefine(role)}
  ${use(extraTexel(role), extraUv(role))}
#endif`,
  `
#ifdef ${extraMapDefine("anisotropy")}
  ${extraUv("anisotropy")}
#elif defined(USE_NORMALMAP)
  vNormalMapUv
#elif defined(USE_MAP)
  vMapUv
#else
  vec2(0.0)
#endif
`,
);

/** How much larger lengths are in the scene than in the shape's own units. */
const shapeScaleChunk = /* glsl */ `
#ifdef ${instancesDefine}
  vShapeScale = length(vec3(instanceTexel(0).x, instanceTexel(1).x, instanceTexel(2).x)) / instanceTexel(3).x;
#else
  vShapeScale = length(modelMatrix[0].xyz) / latticeStep.x;
#endif
`;

/**
 * What replaces three.js' lighting chunks: `lighting`, or, in a material with extensions, the result of `extended` and
 * the chunks of its extensions. `extended` is called with the lighting functions of extensions.
 */
export function lightingChunks(
  defines: Readonly<Record<string, unknown>>,
  lighting: string,
  extended: (replacement: string) => string,
): readonly (readonly [string, string])[] {
  if (!(extendedDefine in defines)) return [["#include <lights_phong_pars_fragment>", lighting]];
  return [
    ["#include <lights_phong_pars_fragment>", extended(extendedLighting)],
    ["#include <normal_fragment_maps>", `vec3 faceNormal = normal;\n#include <normal_fragment_maps>`],
    ["#include <lights_fragment_begin>", `${surfaceChunk}\n#include <lights_fragment_begin>`],
    ["#include <lights_fragment_end>", `#include <lights_fragment_end>\n${transmissionChunk}`],
  ];
}

/** The vertex shader of a material with extensions. */
export function extendedVertexShader(vertexShader: string): string {
  return replaceChunks(vertexShader, [
    ["#include <common>", "#include <common>\nvarying float vShapeScale;"],
    ["#include <fog_vertex>", `#include <fog_vertex>\n${shapeScaleChunk}`],
  ]);
}

/** What has been drawn of a frame before the first surface that transmits light. */
export class Backdrop {
  readonly uniform: { value: Texture | null } = { value: null };
  #texture: FramebufferTexture | undefined;
  #frame = -1;

  /** Copies the canvas, once in each frame. */
  capture(renderer: WebGLRenderer): void {
    const { frame } = renderer.info.render;
    if (frame === this.#frame) return;
    this.#frame = frame;
    const { x: width, y: height } = renderer.getDrawingBufferSize(new Vector2());
    if (this.#texture?.image.width !== width || this.#texture.image.height !== height) {
      this.#texture?.dispose();
      this.#texture = new FramebufferTexture(width, height);
      this.#texture.magFilter = LinearFilter;
      this.#texture.minFilter = LinearMipmapLinearFilter;
      this.#texture.generateMipmaps = true;
      this.uniform.value = this.#texture;
    }
    renderer.copyFramebufferToTexture(this.#texture);
    const gl = renderer.getContext() as WebGL2RenderingContext;
    const { __webglTexture: webglTexture } = renderer.properties.get(this.#texture) as { __webglTexture: WebGLTexture };
    renderer.state.bindTexture(gl.TEXTURE_2D, webglTexture);
    gl.generateMipmap(gl.TEXTURE_2D); // rough surfaces read coarser levels
    renderer.state.unbindTexture();
  }
}
