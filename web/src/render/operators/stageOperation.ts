// The operators that map the vertices of a stage: their uniforms, and what they do outside of shaders, for bounds,
// faces and picking.

import type { Object3D } from "three";
import { Box3, Sphere, Vector3 } from "three";
import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import type { Operator } from "../../document/operators.ts";
import { blurRadiusOf, orientationOf } from "../../document/operators.ts";
import type { OperatorFrame } from "../../document/operatorFrame.ts";
import { operatedBoxInFrame, operatedInFrame } from "../../document/operatorFrame.ts";
import { operatorFrameOf } from "../../scene/operatorFrame.ts";
import type { BufferStage, CoordImage, Stage } from "../../stage/stage.ts";
import type { MaterialRequest } from "../materials/materialFactory.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { lateImageVertices } from "../shaders/lateImageVertices.ts";
import { blurredDefinesOf, operatorsDefine } from "../shaders/vertexFormat.ts";
import type { BlurredVertices } from "../stages/blurredVertices.ts";
import type { OperatorUniforms } from "./operatorChunk.ts";
import { operatorUniformsOf } from "./operatorChunk.ts";

/** What operators change of the requests for materials. Other materials are made where it changes. */
export type OperatedFormat = Pick<MaterialRequest, "operatorDefines" | "isFlipped" | "solid">;

/** Bounds of vertices as they are stored. */
interface StoredBounds {
  readonly box: Box3;
  readonly sphere: Sphere;
}

export class StageOperation {
  /** Where the shader cannot filter the vertices itself. */
  readonly blurred: BlurredVertices | undefined;
  readonly #frame: OperatorFrame;
  readonly #stored: StoredBounds;
  #operators: readonly Operator[] = [];
  #sphere: Sphere;

  constructor(
    geometry: GeometryDescription,
    patch: PatchDescription,
    stage: Stage,
    stored: StoredBounds,
    operators: readonly Operator[],
    buffers: BufferProvider,
  ) {
    if (isBlurredInBuffers(stage, operators))
      this.blurred = lateImageVertices.required.blurredVertices(stage, stage.coordImage, geometry, patch, buffers);
    this.#frame = operatorFrameOf(geometry, patch, stage.bounds);
    this.#stored = stored;
    this.#sphere = stored.sphere;
    this.follow(operators);
  }

  /** Those of the operators that it follows. */
  get uniforms(): OperatorUniforms {
    return {
      ...operatorUniformsOf(this.#operators, this.#frame),
      ...(this.blurred && { blurredImage: { value: this.blurred.texture } }),
    };
  }

  /** Bounds of the mapped vertices, in stored coordinates. */
  get bounds(): Sphere {
    return this.#sphere;
  }

  /** Only for operators with an equal format. */
  follow(operators: readonly Operator[]): void {
    if (operators === this.#operators) return;
    this.#operators = operators;
    this.blurred?.follow(blurRadiusOf(operators));
    const { box, sphere } = this.#stored;
    // The sphere has room for missing bytes.
    const slack = Math.max(0, sphere.radius - box.min.distanceTo(box.max) / 2);
    const { min, max } = operatedBoxInFrame(operators, this.#frame, {
      min: box.min.clone().subScalar(slack).toArray(),
      max: box.max.clone().addScalar(slack).toArray(),
    });
    this.#sphere = new Box3(new Vector3(...min), new Vector3(...max)).getBoundingSphere(new Sphere());
  }

  /** Three.js culls an object by its own sphere, if it has one, and otherwise by that of its geometry. */
  setBounds(object: Object3D): void {
    Object.assign(object, { boundingSphere: this.#sphere });
  }

  dispose(): void {
    this.blurred?.dispose();
  }

  /** The mapped point of a vertex, in stored coordinates. */
  pointOf(stored: Vector3): Vector3 {
    return stored.set(...operatedInFrame(this.#operators, this.#frame, stored.toArray()));
  }
}

/** Folded surfaces are visible from both sides. */
export function formatOf(stage: Stage, { solid }: GeometryDescription, operators: readonly Operator[]): OperatedFormat {
  const orientation = orientationOf(operators);
  const grid = stage.kind === "buffers" ? stage.coordImage?.grid : stage.grid;
  return {
    operatorDefines: {
      [operatorsDefine]: "",
      ...(isBlurred(stage, operators) && blurredDefinesOf(grid !== undefined)),
    },
    isFlipped: orientation === "flipped",
    solid: solid && orientation !== "folded",
  };
}

function isBlurred(stage: Stage, operators: readonly Operator[]): boolean {
  return stage.kind === "buffers" ? isBlurredInBuffers(stage, operators) : blurRadiusOf(operators) > 0;
}

/** Whether the vertices of a stage have to be filtered before the shader gets them. */
function isBlurredInBuffers(
  stage: Stage,
  operators: readonly Operator[],
): stage is BufferStage & { readonly coordImage: CoordImage } {
  return stage.kind === "buffers" && stage.coordImage !== undefined && blurRadiusOf(operators) > 0;
}
