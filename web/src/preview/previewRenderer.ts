// Draws a preview into a WebGL context of its own, without three.js' renderer.

import { Matrix3, Matrix4, Vector3 } from "three";
import type { Base } from "../decode/compact/baseBuffers.ts";
import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import type { TriangleRange } from "../levels/drawRanges.ts";
import type { ElementArray, VertexArray } from "../stage/vertexArray.ts";
import { elementTypeOf, glTypeOf } from "../stage/elementType.ts";
import type { PatchDescription } from "../document/description.ts";
import { latticeBitsOf } from "../document/encodings.ts";
import { isBlended, litParametersOf } from "../lighting/materialParameters.ts";
import { lensOf } from "../navigation/cameraPose.ts";
import type { EffectScope } from "../scene/effectScope.ts";
import type { Camera } from "../scheduler/viewMetrics.ts";
import { planesOf } from "../scheduler/viewMetrics.ts";
import type { LightUniforms } from "./previewLights.ts";
import { lightKindsOf, lightUniformsOf } from "./previewLights.ts";
import type { PreviewProgram, PreviewProgramKind } from "./previewProgram.ts";
import { attributeLocations, makePreviewProgram } from "./previewProgram.ts";
import { resolveOffScreen, warmUpBuffers } from "./warmUp.ts";
import type { PreviewScene, PreviewShape } from "./previewScene.ts";

/** Triangles on the GPU. */
export interface PreviewMesh {
  readonly buffers: PatchBuffers;
  /** Those that are drawn; absent: all. */
  readonly ranges?: readonly TriangleRange[];
}

/** What a preview draws of a shape: its whole base, or all of its patches or groups. */
export type MeshesOf = (shape: PreviewShape) => readonly PreviewMesh[];

/** Whether a base matches what the document states of its shape, and is opaque. */
export function isDrawable(shape: PreviewShape, base: Base | undefined): boolean {
  const { levels, patches } = shape.geometry;
  // The segments of a root are those of its children.
  const hasSegments = levels !== undefined || base?.segmentCount === patches.length;
  return base !== undefined && hasSegments && isOpaqueOnLattice(shape, base.whole);
}

/** Whether a patch matches what the document states of it, and is opaque. */
export function isDrawablePatch(
  shape: PreviewShape,
  { vertexCount, draws: [draw, ...others] }: PatchDescription,
  buffers: PatchBuffers | undefined,
): boolean {
  return (
    buffers?.index !== undefined &&
    isOpaqueOnLattice(shape, buffers) &&
    (vertexCount === 0 || vertexCount === buffers.vertexCount) &&
    others.length === 0 &&
    buffers.topology === "triangles" &&
    draw?.primitive === "triangles" &&
    draw.count === buffers.index.length
  );
}

/** Whether a group of triangles of a level of detail is as the document states, and opaque. */
export function isDrawableGroup(shape: PreviewShape, { buffers }: PreviewMesh): boolean {
  return buffers.index !== undefined && buffers.topology === "triangles" && isOpaqueOnLattice(shape, buffers);
}

function isOpaqueOnLattice(
  { geometry, appearance }: PreviewShape,
  { positionBits, attributes: { color } }: PatchBuffers,
): boolean {
  return positionBits === latticeBitsOf(geometry) && !isBlended(appearance, color?.components === 4);
}

/** A base mesh on the GPU. */
interface GpuMesh {
  readonly vertices: WebGLVertexArrayObject;
  readonly count: number;
  readonly indexType: number;
  readonly indexBytes: number;
}

export class PreviewRenderer {
  readonly #gl: WebGL2RenderingContext;
  readonly #programs = new Map<string, PreviewProgram>();
  readonly #meshes = new Map<PatchBuffers, GpuMesh>();
  readonly #buffers: WebGLBuffer[] = [];

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
    gl.vertexAttrib3f(attributeLocations.color, 1, 1, 1);
  }

  /**
   * Prepares the GPU for the scene before its bases have loaded. Drivers finish compiling a
   * program at the first draw with it, and allocate a canvas' memory at the first draw
   * into it; both can take longer than drawing the bases.
   */
  warmUp(scene: PreviewScene, width: number, height: number): void {
    const shapes = Array.from(
      new Map(scene.shapes.map((shape) => [JSON.stringify(kindOf(shape, scene, warmUpBuffers)), shape])).values(),
    );
    this.#draw({ ...scene, shapes }, () => [{ buffers: warmUpBuffers }], width, height, 1);
    resolveOffScreen(this.#gl);
  }

  /** Draws the scene. The size is in device pixels. Every mesh must be drawable. */
  draw(scene: PreviewScene, meshesOf: MeshesOf, width: number, height: number, exposure: number): void {
    this.#draw(scene, meshesOf, width, height, exposure);
  }

  #draw(scene: PreviewScene, meshesOf: MeshesOf, width: number, height: number, exposure: number): void {
    const gl = this.#gl;
    const { background } = scene;
    gl.viewport(0, 0, width, height);
    gl.clearColor(...(background ?? [0, 0, 0]), background ? 1 : 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    const { clipFromView, viewFromScene } = cameraMatricesOf(scene, width / height);
    const uniformsByScope = new Map<EffectScope, LightUniforms>();
    for (const shape of scene.shapes) {
      const lights = uniformsByScope.get(shape.effectScope) ?? lightUniformsOf(scene, shape.effectScope, viewFromScene);
      uniformsByScope.set(shape.effectScope, lights);
      for (const mesh of meshesOf(shape)) {
        const { buffers } = mesh;
        const program = this.#programFor(kindOf(shape, scene, buffers));
        gl.useProgram(program.program);
        gl.uniformMatrix4fv(program.uniform("clipFromView"), false, clipFromView.elements);
        gl.uniform1f(program.uniform("exposure"), exposure);
        setLightUniforms(gl, program, lights);
        setMaterialUniforms(gl, program, shape, buffers.attributes.color !== undefined);
        setGeometryState(gl, program, new Matrix4().multiplyMatrices(viewFromScene, shape.sceneFromShape), shape);
        this.#drawMesh(mesh);
      }
    }
  }

  /** Frees the vertices of all meshes. What has been drawn stays. */
  freeMeshes(): void {
    const gl = this.#gl;
    for (const { vertices } of this.#meshes.values()) gl.deleteVertexArray(vertices);
    for (const buffer of this.#buffers) gl.deleteBuffer(buffer);
    this.#meshes.clear();
    this.#buffers.length = 0;
  }

  /** Frees everything on the GPU, and loses the context. */
  dispose(): void {
    const gl = this.#gl;
    this.freeMeshes();
    for (const { program } of this.#programs.values()) gl.deleteProgram(program);
    gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  #programFor(kind: PreviewProgramKind): PreviewProgram {
    const key = JSON.stringify(kind);
    const program = this.#programs.get(key) ?? makePreviewProgram(this.#gl, kind);
    this.#programs.set(key, program);
    return program;
  }

  #drawMesh({ buffers, ranges }: PreviewMesh): void {
    const gl = this.#gl;
    const mesh = this.#meshes.get(buffers) ?? this.#uploadMesh(buffers);
    this.#meshes.set(buffers, mesh);
    gl.bindVertexArray(mesh.vertices);
    for (const { first, count } of ranges ?? [{ first: 0, count: mesh.count / 3 }])
      gl.drawElements(gl.TRIANGLES, 3 * count, mesh.indexType, 3 * first * mesh.indexBytes);
  }

  #uploadMesh({ coord, attributes: { normal, color }, index }: PatchBuffers): GpuMesh {
    const gl = this.#gl;
    const vertices = gl.createVertexArray();
    gl.bindVertexArray(vertices);
    this.#uploadAttribute(attributeLocations.position, coord, false);
    if (normal) this.#uploadAttribute(attributeLocations.normal, normal, true);
    if (color) this.#uploadAttribute(attributeLocations.color, color, true);
    if (index) this.#uploadBuffer(gl.ELEMENT_ARRAY_BUFFER, index);
    return {
      vertices,
      count: index?.length ?? 0,
      indexType: index instanceof Uint32Array ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT,
      indexBytes: index?.BYTES_PER_ELEMENT ?? 0,
    };
  }

  /** `isNormalized`: integers are mapped to 0 … 1, signed ones to -1 … 1. */
  #uploadAttribute(location: number, { array, components, stride, offset }: VertexArray, isNormalized: boolean): void {
    const gl = this.#gl;
    const elementBytes = array.BYTES_PER_ELEMENT;
    this.#uploadBuffer(gl.ARRAY_BUFFER, array);
    gl.enableVertexAttribArray(location);
    const isFloat = array instanceof Float32Array;
    gl.vertexAttribPointer(
      location,
      components,
      glTypeOf(elementTypeOf(array)),
      isNormalized && !isFloat,
      stride * elementBytes,
      offset * elementBytes,
    );
  }

  #uploadBuffer(target: number, array: ElementArray): void {
    const gl = this.#gl;
    const buffer = gl.createBuffer();
    this.#buffers.push(buffer);
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, array, gl.STATIC_DRAW);
  }
}

function kindOf(
  { geometry, appearance }: PreviewShape,
  scene: PreviewScene,
  { attributes }: PatchBuffers,
): PreviewProgramKind {
  return {
    hasNormals: attributes.normal !== undefined,
    material: appearance.material.kind,
    isTwoSided: !geometry.solid,
    lights: lightKindsOf(scene),
  };
}

/** The camera, as the runtime has it for a canvas of this size in device pixels. */
export function previewCameraOf(scene: PreviewScene, width: number, height: number): Camera {
  const { clipFromView, viewFromScene } = cameraMatricesOf(scene, width / height);
  return {
    position: scene.pose.position.toArray(),
    planes: planesOf(new Matrix4().multiplyMatrices(clipFromView, viewFromScene).elements),
    pixelsPerUnit: (clipFromView.elements[5] * height) / 2,
    near: lensOf(scene.pose, width / height, scene.sphere, scene.clearance).near,
  };
}

/** The matrices of the camera, equal to the runtime's. */
function cameraMatricesOf(
  { pose, sphere, clearance }: PreviewScene,
  aspect: number,
): { clipFromView: Matrix4; viewFromScene: Matrix4 } {
  const { fieldOfView, near, far } = lensOf(pose, aspect, sphere, clearance);
  const top = near * Math.tan(fieldOfView / 2);
  const sceneFromView = new Matrix4().compose(pose.position, pose.orientation, new Vector3(1, 1, 1));
  return {
    clipFromView: new Matrix4().makePerspective(-top * aspect, top * aspect, top, -top, near, far),
    viewFromScene: sceneFromView.invert(),
  };
}

function setGeometryState(
  gl: WebGL2RenderingContext,
  { uniform }: PreviewProgram,
  viewFromShape: Matrix4,
  { sceneFromShape, shapeFromStored, geometry }: PreviewShape,
): void {
  gl.uniformMatrix4fv(
    uniform("viewFromStored"),
    false,
    new Matrix4().multiplyMatrices(viewFromShape, shapeFromStored).elements,
  );
  gl.uniformMatrix3fv(uniform("viewFromNormal"), false, new Matrix3().getNormalMatrix(viewFromShape).elements);
  gl.frontFace(sceneFromShape.determinant() < 0 ? gl.CW : gl.CCW);
  if (geometry.solid) gl.enable(gl.CULL_FACE);
  else gl.disable(gl.CULL_FACE);
}

function setMaterialUniforms(
  gl: WebGL2RenderingContext,
  { uniform }: PreviewProgram,
  { appearance: { material } }: PreviewShape,
  hasColors: boolean,
): void {
  const { color, specular, shininess, ambientIntensity, metallic, roughness } = litParametersOf(material, hasColors);
  gl.uniform3fv(uniform("color"), color);
  gl.uniform3fv(uniform("specular"), specular);
  gl.uniform3fv(uniform("emissive"), material.emissiveColor);
  gl.uniform1f(uniform("shininess"), shininess);
  gl.uniform1f(uniform("ambientIntensity"), ambientIntensity);
  gl.uniform1f(uniform("metallic"), metallic);
  gl.uniform1f(uniform("roughness"), roughness);
}

function setLightUniforms(gl: WebGL2RenderingContext, { uniform }: PreviewProgram, lights: LightUniforms): void {
  gl.uniform3fv(uniform("lightColors"), lights.lightColors);
  gl.uniform3fv(uniform("lightPositions"), lights.lightPositions);
  gl.uniform3fv(uniform("lightDirections"), lights.lightDirections);
  gl.uniform3fv(uniform("lightAttenuations"), lights.lightAttenuations);
  gl.uniform1fv(uniform("lightRadii"), lights.lightRadii);
  gl.uniform2fv(uniform("lightCones"), lights.lightCones);
  gl.uniform3fv(uniform("ambientLight"), lights.ambientLight);
}
