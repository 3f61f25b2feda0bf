// PhysicalMaterials with extensions in pages; extendedShaders.ts has their GLSL.

import type { IUniform, Material, Texture, WebGLRenderer } from "three";
import { FramebufferTexture, LinearFilter, LinearMipmapLinearFilter, Vector2 } from "three";
import type { MaterialDescription, MaterialExtensions } from "../../document/description.ts";
import { LateModule } from "../../document/lateModule.ts";
import { extendedDefine, extensionUniforms } from "../../lighting/extensionUniforms.ts";
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

/** The GLSL of extensions, which is a module of its own (document/parts.ts). */
export interface ExtensionShaders {
  /** What replaces three.js' lighting chunks. `lighting` makes a chunk of the lighting functions of extensions. */
  readonly lightingChunks: (lighting: (functions: string) => string) => readonly (readonly [string, string])[];
  readonly vertexShader: (vertexShader: string) => string;
}

export const lateExtensionShaders = new LateModule<ExtensionShaders>("extensions of materials");

/** The GLSL of a material with these #defines; undefined: it has no extensions. Throws RangeError before it is loaded. */
export function extensionShadersFor(defines: Readonly<Record<string, unknown>>): ExtensionShaders | undefined {
  return extendedDefine in defines ? lateExtensionShaders.required : undefined;
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
