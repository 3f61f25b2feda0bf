// The operators that map the vertices of a stage, outside of its shaders: for bounds, faces and picking.

import type { Object3D } from "three";
import { Box3, Sphere, Vector3 } from "three";
import type { AppearanceDescription, GeometryDescription, PatchDescription } from "../../document/description.ts";
import type { Operator } from "../../document/operators.ts";
import { blurRadiusOf, orientationOf } from "../../document/operators.ts";
import type { OperatorFrame } from "../../document/operatorFrame.ts";
import { operatedBoxInFrame, operatedInFrame } from "../../document/operatorFrame.ts";
import { operatorFrameOf } from "../../scene/operatorFrame.ts";
import type { BufferStage, CoordImage, Stage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { lateImageVertices } from "../shaders/lateImageVertices.ts";
import type { BlurredVertices } from "./blurredVertices.ts";
import type { MaterialRequest } from "../materials/materialFactory.ts";

/** Bounds of vertices as they are stored. */
interface StoredBounds {
  readonly box: Box3;
  readonly sphere: Sphere;
}

export class StageOperation {
  readonly frame: OperatorFrame;
  /** Whether the stage is drawn after the operator blur. */
  readonly isBlurred: boolean;
  /** Where the shader cannot filter the vertices itself. */
  readonly blurred: BlurredVertices | undefined;
  readonly #stored: StoredBounds;
  #operators: readonly Operator[] = [];
  #sphere: Sphere;

  constructor(
    geometry: GeometryDescription,
    patch: PatchDescription,
    stage: Stage,
    stored: StoredBounds,
    appearance: AppearanceDescription,
    buffers: BufferProvider,
  ) {
    this.isBlurred = isBlurred(stage, appearance);
    if (hasBlurredBuffers(stage, appearance))
      this.blurred = lateImageVertices().blurredVertices(stage, stage.coordImage, geometry, patch, buffers);
    this.frame = operatorFrameOf(geometry, patch, stage.bounds);
    this.#stored = stored;
    this.#sphere = stored.sphere;
    this.follow(appearance);
  }

  /** Bounds of the mapped vertices, in stored coordinates. */
  get bounds(): Sphere {
    return this.#sphere;
  }

  follow({ operators = [] }: AppearanceDescription): void {
    if (operators === this.#operators) return;
    this.#operators = operators;
    this.blurred?.follow(blurRadiusOf(operators));
    const { box, sphere } = this.#stored;
    this.#sphere = sphere;
    if (operators.length === 0) return;
    // The sphere has room for missing bytes.
    const slack = Math.max(0, sphere.radius - box.min.distanceTo(box.max) / 2);
    const { min, max } = operatedBoxInFrame(operators, this.frame, {
      min: box.min.clone().subScalar(slack).toArray(),
      max: box.max.clone().addScalar(slack).toArray(),
    });
    this.#sphere = new Box3(new Vector3(...min), new Vector3(...max)).getBoundingSphere(new Sphere());
  }

  /** Three.js culls an object by its own sphere, if it has one, and otherwise by that of its geometry. */
  setBounds(object: Object3D): void {
    if (this.#operators.length === 0 && !("boundingSphere" in object)) return;
    Object.assign(object, { boundingSphere: this.#sphere });
  }

  dispose(): void {
    this.blurred?.dispose();
  }

  /** The mapped point of a vertex, in stored coordinates. */
  pointOf(stored: Vector3): Vector3 {
    if (this.#operators.length === 0) return stored;
    return stored.set(...operatedInFrame(this.#operators, this.frame, stored.toArray()));
  }
}

/** Whether vertices are drawn after the operator blur, with shaders of their own. */
export function isBlurred(stage: Stage, appearance: AppearanceDescription): boolean {
  if (stage.kind === "buffers") return hasBlurredBuffers(stage, appearance);
  return blurRadiusOf(appearance.operators ?? []) > 0;
}

/** Whether the vertices of a stage have to be filtered before the shader gets them. */
function hasBlurredBuffers(
  stage: Stage,
  { operators = [] }: AppearanceDescription,
): stage is BufferStage & { readonly coordImage: CoordImage } {
  return stage.kind === "buffers" && stage.coordImage !== undefined && blurRadiusOf(operators) > 0;
}

/** Which faces of a geometry are drawn after its operators. Folded ones are visible from both sides. */
export function facesOf(
  { solid }: GeometryDescription,
  { operators = [] }: AppearanceDescription,
): Pick<MaterialRequest, "solid" | "isFlipped"> {
  const orientation = orientationOf(operators);
  return { solid: solid && orientation !== "folded", isFlipped: orientation === "flipped" };
}
