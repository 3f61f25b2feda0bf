// A cube map that is composed of pictures on the GPU: each side is drawn into a face of a cube texture, whose faces are
// numbered and turned as in OpenGL (+x, -x, +y, -y, +z, -z). X3D's front is +z, as in X_ITE and X3DOM.

import type { CubeTexture, Texture, WebGLRenderer } from "three";
import {
  BufferAttribute,
  BufferGeometry,
  Camera,
  LinearMipmapLinearFilter,
  Mesh,
  NoBlending,
  RawShaderMaterial,
  Scene,
  GLSL3,
  Vector4,
  WebGLCubeRenderTarget,
} from "three";
import type { CubeMapRole, PanoramaSide } from "../../document/description.ts";
import { cubeLayoutOf } from "./cubeLayout.ts";

/** In the order of the faces of a cube texture. */
const faces: readonly PanoramaSide[] = ["right", "left", "top", "bottom", "front", "back"];

// The triangle covers the face. Its rows begin at the top of the picture, whose texture begins at the bottom.
const vertexShader = /* glsl */ `
in vec3 position;
out vec2 fromTopLeft;
void main() {
  fromTopLeft = 0.5 + 0.5 * position.xy;
  gl_Position = vec4(position, 1.0);
}
`;

const fragmentShader = /* glsl */ `
precision highp float;
uniform sampler2D picture;
// Left, top, width and height of the side in the picture; negative sizes turn it by half a turn.
uniform vec4 area;
in vec2 fromTopLeft;
out vec4 color;
void main() {
  // Not beyond the middle of the outer texels: the sides of one picture would bleed into one another.
  vec2 inset = 0.5 / abs(area.zw) / vec2(textureSize(picture, 0));
  vec2 at = area.xy + area.zw * clamp(fromTopLeft, inset, 1.0 - inset);
  color = texture(picture, vec2(at.x, 1.0 - at.y));
}
`;

/** Draws pictures into faces; one for all cube maps. */
export class CubeFaceDrawing {
  readonly #camera = new Camera();
  readonly #scene = new Scene();
  readonly #uniforms = { picture: { value: null as Texture | null }, area: { value: new Vector4() } };
  readonly #mesh: Mesh<BufferGeometry, RawShaderMaterial>;

  constructor() {
    const corners = new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]);
    this.#mesh = new Mesh(
      new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3)),
      new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader,
        fragmentShader,
        uniforms: this.#uniforms,
        depthTest: false,
        depthWrite: false,
        blending: NoBlending,
      }),
    );
    this.#mesh.frustumCulled = false;
    this.#scene.add(this.#mesh);
  }

  /** Without a picture the face becomes black. */
  draw(renderer: WebGLRenderer, picture: Texture | undefined, area: Vector4): void {
    this.#mesh.visible = picture !== undefined;
    this.#uniforms.picture.value = picture ?? null;
    this.#uniforms.area.value = area;
    renderer.render(this.#scene, this.#camera);
  }

  dispose(): void {
    this.#mesh.geometry.dispose();
    this.#mesh.material.dispose();
  }
}

export class CubeMap {
  readonly #pictures = new Map<CubeMapRole, Texture>();
  #target: WebGLCubeRenderTarget | undefined;
  #isChanged = false;

  /** Sets a picture, which stays as it is while the cube map has it; undefined: removes it. */
  setPicture(role: CubeMapRole, texture: Texture | undefined): void {
    if (this.#pictures.get(role) === texture) return;
    if (texture) this.#pictures.set(role, texture);
    else this.#pictures.delete(role);
    this.#isChanged = true;
  }

  /** Undefined before the first picture has been drawn. */
  get texture(): CubeTexture | undefined {
    return this.#target?.texture;
  }

  /** Edge of a face in texels; 0 where there is no texture. */
  get size(): number {
    return this.#target?.width ?? 0;
  }

  /** Draws the pictures into the texture if one has changed. Returns whether the texture is another one. */
  update(renderer: WebGLRenderer, drawing: CubeFaceDrawing): boolean {
    if (!this.#isChanged) return false;
    this.#isChanged = false;
    const before = this.#target;
    const areas = faces.map((side) => this.#areaOf(side));
    const size = Math.min(Math.max(0, ...areas.map((area) => area?.size ?? 0)), renderer.capabilities.maxCubemapSize);
    if (before?.width !== size) {
      before?.dispose();
      this.#target = size === 0 ? undefined : makeTarget(size);
    }
    if (this.#target !== undefined) this.#draw(renderer, drawing, this.#target, areas);
    return before !== this.#target;
  }

  dispose(): void {
    this.#target?.dispose();
    this.#target = undefined;
    this.#pictures.clear();
  }

  #areaOf(side: PanoramaSide): { picture: Texture; area: Vector4; size: number } | undefined {
    const picture = this.#pictures.get(side);
    if (picture) return { picture, area: new Vector4(0, 0, 1, 1), size: Math.max(...sizeOf(picture)) };
    const whole = this.#pictures.get("whole");
    const [width, height] = whole ? sizeOf(whole) : [0, 0];
    const area = cubeLayoutOf(width, height)?.[side];
    return whole && area
      ? { picture: whole, area: new Vector4(...area), size: Math.round(width * Math.abs(area[2])) }
      : undefined;
  }

  #draw(
    renderer: WebGLRenderer,
    drawing: CubeFaceDrawing,
    target: WebGLCubeRenderTarget,
    areas: readonly ({ picture: Texture; area: Vector4 } | undefined)[],
  ): void {
    areas.forEach((side, face) => {
      // Each rendering into a texture with mipmaps makes them.
      target.texture.generateMipmaps = face === areas.length - 1;
      renderer.setRenderTarget(target, face);
      drawing.draw(renderer, side?.picture, side?.area ?? new Vector4());
    });
    renderer.setRenderTarget(null);
  }
}

function sizeOf(texture: Texture): readonly [width: number, height: number] {
  const { width, height } = texture.image as { width: number; height: number };
  return [width, height];
}

function makeTarget(size: number): WebGLCubeRenderTarget {
  return new WebGLCubeRenderTarget(size, {
    generateMipmaps: true,
    minFilter: LinearMipmapLinearFilter,
    depthBuffer: false,
  });
}
