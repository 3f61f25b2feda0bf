// What draws look like: in pages as X3D says (materials.ts), in other people's
// three.js apps as those say (loader/appLook.ts). Where their vertices come from
// is the same for all.

import type { Material, Vector2, Vector4 } from "three";
import type { AppearanceDescription } from "../../document/description.ts";
import type { DrawRange } from "../../stage/stage.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { SceneLightUniforms } from "../lights/sceneLights.ts";
import type { VertexFormat } from "../shaders/vertexFormat.ts";
import type { VertexUniforms } from "../shaders/vertexFormat.ts";
import type { SurfaceTextures } from "./surfaceTextures.ts";

export interface MaterialFactory {
  /** How draws of several shapes go together; undefined: they do not. */
  readonly batching: BatchingRules | undefined;
  makeMaterial(request: MaterialRequest, appearance: AppearanceDescription, surfaceTextures: SurfaceTextures): Material;
  /** Changes a material of this look in place. */
  applyAppearance(
    material: Material,
    appearance: AppearanceDescription,
    colors: VertexColors,
    surfaceTextures: SurfaceTextures,
  ): void;
  /** Gives an object what it needs besides its material. */
  prepareObject(object: DrawnObject, request: MaterialRequest, material: Material): void;
}

/** What shapes that are drawn together have in common, and what each has of its own. */
export interface BatchingRules {
  /** The same for appearances that one material can show. */
  materialKeyOf(
    request: Pick<MaterialRequest, "primitive" | "colors">,
    appearance: AppearanceDescription,
    surfaceTextures: SurfaceTextures,
  ): string;
  /** Drawn in the order of their distance, the farthest first. */
  isBlended(
    request: Pick<MaterialRequest, "colors">,
    appearance: AppearanceDescription,
    surfaceTextures: SurfaceTextures,
  ): boolean;
  /** The rest of an appearance, for the shader: the field `look` of a place's record. */
  instanceNumbersOf(
    request: Pick<MaterialRequest, "shading" | "colors">,
    appearance: AppearanceDescription,
  ): readonly number[];
}

/** What is blended with less is not there: it would hide what is drawn after it and lies behind, as a cornea its eye. */
export const minAlpha = 1 / 512;

/** Unlit for points and lines, by distance for points that stand in for a surface, flat where there are no normals (yet). */
export type Shading = "unlit" | "distance" | "flat" | "smooth";

/** What colours the vertices bring: those with alpha blend. */
export type VertexColors = "none" | "rgb" | "rgba";

/** Uniforms that everything in a scene shares. */
export interface SceneUniforms extends SceneLightUniforms {
  /** Device pixels in a CSS pixel. */
  readonly pixelRatio: { value: number };
  /** Of what is being drawn, in device pixels: origin and size. Wide lines follow it. */
  readonly viewport: { value: Vector4 };
  /** Distances along the view between which the scene lies. */
  readonly depthRange: { value: Vector2 };
}

export interface MaterialRequest extends VertexFormat {
  readonly primitive: DrawRange["primitive"];
  readonly shading: Shading;
  readonly colors: VertexColors;
  /** False: both sides are seen. */
  readonly solid: boolean;
  /** As valueDefinesOf says it. */
  readonly valueDefines: Readonly<Record<string, string>>;
  readonly uniforms: Partial<VertexUniforms>;
  readonly shared: SceneUniforms;
}
