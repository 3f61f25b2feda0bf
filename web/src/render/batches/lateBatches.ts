// The batches of a scene, in a module of their own (document/parts.ts): scenes of few shapes have none.

import type { Camera, Sphere } from "three";
import { Group } from "three";
import { LateModule } from "../../document/lateModule.ts";
import type { Stage } from "../../stage/stage.ts";
import type { BatchingRules, MaterialFactory } from "../materials/materialFactory.ts";
import type { PatchContext } from "../stages/patchContext.ts";
import type { GeometryPool } from "../stages/geometryPool.ts";
import type { PatchDraws } from "../stages/patchDraws.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { BatchedGroup } from "./batch.ts";
import type { BatchContext } from "./batchedStage.ts";
import type { Batches } from "./batches.ts";

/** What the module adds. */
export interface BatchMakers {
  readonly batches: (materialFactory: MaterialFactory, geometries: GeometryPool, buffers: BufferProvider) => Batches;
  readonly stage: (stage: Stage, context: PatchContext, batch: BatchContext) => PatchDraws;
}

export const batchMakers = new LateModule<BatchMakers>("batches");

export class LateBatches {
  /** Parent of all drawn objects. */
  readonly root = new Group();
  readonly #arguments: Parameters<BatchMakers["batches"]>;
  /** Undefined before the first stage. */
  #batches: Batches | undefined;
  #sceneSphere: Sphere | undefined;

  constructor(...of: Parameters<BatchMakers["batches"]>) {
    this.#arguments = of;
  }

  /** Draws a stage in batches. Throws RangeError where the module has not been loaded. */
  drawsOf(
    stage: Stage,
    context: PatchContext,
    { batching, isMerged }: { readonly batching: BatchingRules; readonly isMerged: boolean },
  ): PatchDraws {
    const makers = batchMakers.required;
    this.#batches ??= this.#make(makers);
    return makers.stage(stage, context, { batches: this.#batches, batching, isMerged });
  }

  #make({ batches: make }: BatchMakers): Batches {
    const batches = make(...this.#arguments);
    this.root.add(batches.root);
    if (this.#sceneSphere) batches.setBoundingSphere(this.#sceneSphere);
    return batches;
  }

  /** As those of `Batches`. */
  follow(group: BatchedGroup): void {
    this.#batches?.follow(group);
  }

  setBoundingSphere(sphere: Sphere): void {
    this.#sceneSphere = sphere;
    this.#batches?.setBoundingSphere(sphere);
  }

  updateAllRecords(): void {
    this.#batches?.updateAllRecords();
  }

  update(camera: Camera, margin: readonly [number, number]): void {
    this.#batches?.update(camera, margin);
  }

  dispose(): void {
    this.#batches?.dispose();
  }
}
