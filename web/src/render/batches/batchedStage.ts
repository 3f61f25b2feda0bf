// Draws a stage of a patch in batches, together with other stages.

import { DoubleSide, FrontSide } from "three";
import type { DrawRange, Stage } from "../../stage/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import { dequantizationOf } from "../../document/dequantization.ts";
import { shapeFromStoredOf } from "../../scene/transforms.ts";
import type { ShapeGroup } from "../shapes/shapeGroup.ts";
import type { BatchingRules } from "../materials/materialFactory.ts";
import type { SurfaceTextures } from "../materials/surfaceTextures.ts";
import { applicableTextures } from "../materials/surfaceTextures.ts";
import { texCoordFramesOf } from "../shaders/texCoords.ts";
import type { PatchDraws } from "../stages/patchDraws.ts";
import { PickDraw } from "../picking/pickDraw.ts";
import type { PatchContext } from "../stages/patchContext.ts";
import { uniformsOf } from "../stages/stageUniforms.ts";
import { colorsOf, materialRequestOf, pickRequestOf } from "../stages/materialRequests.ts";
import { boundsOf } from "../stages/stageBounds.ts";
import { lateValues } from "../materials/lateValues.ts";
import type { BatchedDraw, Member } from "./batch.ts";
import type { Batches } from "./batches.ts";
import { isBlended } from "./drawMode.ts";

/** How draws are batched. */
export interface BatchContext {
  readonly batches: Batches;
  readonly batching: BatchingRules;
  readonly isMerged: boolean;
}

export class BatchedStage implements PatchDraws {
  readonly picks: readonly PickDraw[];
  readonly #stage: Stage;
  readonly #batch: BatchContext;
  readonly #members = new Map<ShapeGroup, readonly Member[]>();
  #context: PatchContext;
  #draws: readonly BatchedDraw[];

  constructor(stage: Stage, context: PatchContext, batch: BatchContext) {
    this.#stage = stage;
    this.#context = context;
    this.#batch = batch;
    this.#draws = drawsOf(stage, context, batch);
    this.picks = stage.draws.filter(isNotEmpty).map((range) => pickOf(stage, range, () => this.#context));
  }

  addInstance(group: ShapeGroup): void {
    const { batches } = this.#batch;
    this.#members.set(
      group,
      this.#draws.map((draw) => batches.add(draw, this.#instanceNumbersOf(draw), group)),
    );
  }

  updateInstance(group: ShapeGroup): void {
    for (const member of this.#members.get(group) ?? []) this.#batch.batches.updateRecord(member);
  }

  removeInstance(group: ShapeGroup): void {
    for (const member of this.#members.get(group) ?? []) this.#batch.batches.remove(member);
    this.#members.delete(group);
  }

  /** Only for appearances with an unchanged `drawModeOf`. */
  applyAppearance(appearance: AppearanceDescription, surfaceTextures: SurfaceTextures): void {
    this.#context = { ...this.#context, appearance, surfaceTextures };
    for (const pick of this.picks) pick.releaseResources();
    const isSame = this.#draws.every(
      ({ ranges: [range], materialKey }) =>
        range && materialKey === materialKeyOf(this.#stage, range, appearance, surfaceTextures, this.#batch.batching),
    );
    if (isSame) {
      for (const members of this.#members.values())
        for (const member of members)
          this.#batch.batches.setMaterialNumbers(member, this.#instanceNumbersOf(member.draw));
      return;
    }
    this.#draws = drawsOf(this.#stage, this.#context, this.#batch);
    for (const group of Array.from(this.#members.keys())) {
      this.removeInstance(group);
      this.addInstance(group);
    }
  }

  dispose(): void {
    for (const group of Array.from(this.#members.keys())) this.removeInstance(group);
    for (const pick of this.picks) pick.dispose();
  }

  #instanceNumbersOf({ request }: BatchedDraw): readonly number[] {
    return this.#batch.batching.instanceNumbersOf(request, this.#context.appearance);
  }
}

function drawsOf(stage: Stage, context: PatchContext, { batching, isMerged }: BatchContext): BatchedDraw[] {
  const { geometry, patch, appearance, surfaceTextures, shared } = context;
  const uniforms = uniformsOf(stage, context);
  const { sphere: bounds } = boundsOf(geometry, patch, stage);
  const areBlended = isBlended(stage, appearance, surfaceTextures, batching);
  return groupedRangesOf(stage, isMerged, areBlended).flatMap(({ ranges, mayMerge }) => {
    const [first] = ranges;
    if (first === undefined) return [];
    return [
      {
        stage,
        ranges,
        bounds,
        appearance,
        materialKey: materialKeyOf(stage, first, appearance, surfaceTextures, batching),
        isMerged: isMerged && mayMerge,
        isBlended: areBlended,
        vertexCount: stage.kind === "buffers" ? stage.vertexCount : 0,
        ...dequantizationOf(geometry, patch),
        texCoordFrames: texCoordFramesOf(geometry),
        valueFrame: geometry.value && lateValues.required.frameOf(stage, geometry.value),
        request: materialRequestOf(stage, first, geometry, uniforms.of(first), shared, true),
        surfaceTextures: applicableTextures(stage, appearance, surfaceTextures),
      },
    ];
  });
}

/**
 * Groups the ranges into draws. Merged ranges of one primitive are one draw. Strips of thin lines cannot be merged,
 * because one strip would be joined to the next; blended wide lines cannot, because they have no index to sort.
 */
function groupedRangesOf(
  { kind, draws }: Stage,
  isMerged: boolean,
  areBlended: boolean,
): { ranges: readonly DrawRange[]; mayMerge: boolean }[] {
  const ranges = draws.filter(isNotEmpty);
  const mayMerge = ({ primitive, isWide }: DrawRange) =>
    isMerged && kind === "buffers" && (isWide === true ? !areBlended : primitive !== "lineStrip");
  const primitives = new Set(ranges.filter(mayMerge).map(({ primitive }) => primitive));
  return [
    ...Array.from(primitives, (primitive) => ({
      ranges: ranges.filter((range) => range.primitive === primitive),
      mayMerge: true,
    })),
    ...ranges.filter((range) => !mayMerge(range)).map((range) => ({ ranges: [range], mayMerge: false })),
  ];
}

function isNotEmpty({ count }: DrawRange): boolean {
  return count > 0;
}

function materialKeyOf(
  stage: Stage,
  { primitive }: DrawRange,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
  batching: BatchingRules,
): string {
  return batching.materialKeyOf(
    { primitive, colors: colorsOf(stage) },
    appearance,
    applicableTextures(stage, appearance, surfaceTextures),
  );
}

/** Makes a draw for the picking pass, which draws instances near the pointer one by one. */
function pickOf(stage: Stage, range: DrawRange, currentContext: () => PatchContext): PickDraw {
  const { geometry, patch, buffers, geometries } = currentContext();
  return new PickDraw(stage, range, {
    buffers,
    bounds: boundsOf(geometry, patch, stage).sphere,
    shapeFromStored: shapeFromStoredOf(geometry, patch),
    acquireResources: () => {
      const acquired = geometries.acquire(stage)[stage.draws.indexOf(range)];
      if (acquired === undefined) throw new RangeError("the stage does not have this draw");
      return {
        geometry: acquired,
        request: pickRequestOf(
          stage,
          range,
          geometry.solid && range.isWide !== true ? FrontSide : DoubleSide,
          uniformsOf(stage, currentContext()).of(range),
          currentContext().appearance,
          currentContext().surfaceTextures,
        ),
        release: () => {
          geometries.release(stage);
        },
      };
    },
  });
}
