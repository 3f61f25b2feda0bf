// The interface of material factories. Pages have materials with X3D's lighting (x3dMaterials.ts),
// three.js apps have three.js' own materials (loader/standardMaterials.ts). Both read vertices with
// the same shader chunk (shaders/vertexChunk.ts).

import type { Material, Side, Vector2, Vector4 } from "three";
import { BackSide, DoubleSide, FrontSide } from "three";
import type { AppearanceDescription } from "../../document/description.ts";
import type { DrawRange } from "../../stage/stage.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { SceneEffectUniforms } from "../environment/effectUniforms.ts";
import type { VertexFormat, VertexUniforms } from "../shaders/vertexFormat.ts";
import type { Backdrop } from "./extendedMaterials.ts";
import type { SurfaceTextures } from "./surfaceTextures.ts";

export interface MaterialFactory {
  /** Rules for drawing several shapes with one call; if undefined, each instance is an object of its own. */
  readonly batching: BatchingRules | undefined;
  makeMaterial(request: MaterialRequest, appearance: AppearanceDescription, surfaceTextures: SurfaceTextures): Material;
  /** Updates a material that this factory has made. */
  applyAppearance(
    material: Material,
    appearance: AppearanceDescription,
    colors: VertexColors,
    surfaceTextures: SurfaceTextures,
  ): void;
  /** Sets up an object beyond its material: shadows, callbacks. */
  prepareObject(object: DrawnObject, request: MaterialRequest, material: Material): void;
}

/** Splits an appearance into what a batch's material holds and what each instance's record holds. */
export interface BatchingRules {
  /** A key that is equal for appearances that one material can show, given equal instance records. */
  materialKeyOf(
    request: Pick<MaterialRequest, "primitive" | "colors">,
    appearance: AppearanceDescription,
    surfaceTextures: SurfaceTextures,
  ): string;
  /** Whether the draw blends, and must be drawn in depth order, the farthest first. */
  isBlended(
    request: Pick<MaterialRequest, "colors">,
    appearance: AppearanceDescription,
    surfaceTextures: SurfaceTextures,
  ): boolean;
  /**
   * The remaining numbers of an appearance, which the shader reads from the instance's record: the fields from
   * `material` to `lineWidth` of `instanceFields`.
   */
  instanceNumbersOf(
    request: Pick<MaterialRequest, "shading" | "colors">,
    appearance: AppearanceDescription,
  ): readonly number[];
}

/**
 * Fragments with less alpha are discarded: they are invisible, but would write depth and hide what is drawn behind them
 * later, as a cornea would hide the eye.
 */
export const minAlpha = 1 / 512;

/**
 * `unlit`: points and lines without normals. `distance`: points that stand in for a surface, shaded by depth. `flat`:
 * surfaces without normals (yet). `smooth`: by normals.
 */
export type Shading = "unlit" | "distance" | "flat" | "smooth";

/** The vertex colours of a stage; those with alpha may blend. */
export type VertexColors = "none" | "rgb" | "rgba";

/** Uniforms that all materials of a scene share. */
export interface SceneUniforms extends SceneEffectUniforms {
  /** Device pixels per CSS pixel. */
  readonly pixelRatio: { value: number };
  /** Origin and size of the current viewport in device pixels, for wide lines. */
  readonly viewport: { value: Vector4 };
  /** Nearest and farthest view depth of the scene. */
  readonly depthRange: { value: Vector2 };
  /** Pages only: what surfaces that transmit light show. */
  readonly backdrop?: Backdrop;
}

/** The sides of surfaces that are drawn. */
export function sideOf({
  solid,
  wideLineStep,
  isFlipped = false,
}: Pick<MaterialRequest, "solid" | "wideLineStep" | "isFlipped">): Side {
  return !solid || wideLineStep > 0 ? DoubleSide : isFlipped ? BackSide : FrontSide;
}

export interface MaterialRequest extends VertexFormat {
  readonly primitive: DrawRange["primitive"];
  readonly shading: Shading;
  readonly colors: VertexColors;
  /** Whether back faces are culled. */
  readonly solid: boolean;
  /** Whether operators have mirrored the triangles, so that their back is outside. */
  readonly isFlipped?: boolean;
  /** As valueDefinesOf returns them. */
  readonly valueDefines: Readonly<Record<string, string>>;
  readonly uniforms: Partial<VertexUniforms>;
  readonly shared: SceneUniforms;
}
