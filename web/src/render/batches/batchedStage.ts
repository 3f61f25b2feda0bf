// A stage of a patch that is drawn together with others.

import { DoubleSide, FrontSide } from "three";
import type { DrawRange, Stage } from "../../stage/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import { storedFrameOf } from "../../document/storedFrame.ts";
import { shapeFromStoredOf } from "../../navigation/matrices.ts";
import type { PlaceGroup } from "../lights/lightScopes.ts";
import type { Batching, ShownPictures } from "../materials/materialFactory.ts";
import { noPictures } from "../materials/materialFactory.ts";
import type { PatchDraws } from "../stages/patchDraws.ts";
import { PickDraw } from "../picking/pickDraw.ts";
import type { PatchSetting } from "../stages/stageDraws.ts";
import { boundsOf, colorsOf, materialRequestOf, pickRequestOf, uniformsOf } from "../stages/stageDraws.ts";
import { valueFrameOf } from "../materials/valueColors.ts";
import type { BatchedDraw, Member } from "./batch.ts";
import type { Batches } from "./batches.ts";
import type { DrawnAs, Drawing } from "./batchingPlan.ts";
import { vertexCountOf } from "../vertices/vertexColumns.ts";

/** How draws go together. */
export interface BatchSetting {
  readonly batches: Batches;
  readonly batching: Batching;
  readonly isMerged: boolean;
}

/** How the stage is drawn, of a geometry that is drawn so. */
export function drawnAsOf(
  stage: Stage,
  drawing: Drawing,
  appearance: AppearanceDescription,
  pictures: ShownPictures,
  batching: Batching,
): DrawnAs {
  return isBlended(stage, appearance, pictures, batching) ? drawing.blended : drawing.opaque;
}

export class BatchedStage implements PatchDraws {
  readonly picks: readonly PickDraw[];
  readonly #stage: Stage;
  readonly #batch: BatchSetting;
  readonly #members = new Map<PlaceGroup, readonly Member[]>();
  #setting: PatchSetting;
  #draws: readonly BatchedDraw[];

  constructor(stage: Stage, setting: PatchSetting, batch: BatchSetting) {
    this.#stage = stage;
    this.#setting = setting;
    this.#batch = batch;
    this.#draws = drawsOf(stage, setting, batch);
    this.picks = stage.draws.filter(isSeen).map((range) => pickOf(stage, range, () => this.#setting));
  }

  hang(group: PlaceGroup): void {
    const { batches } = this.#batch;
    this.#members.set(
      group,
      this.#draws.map((draw) => batches.add(draw, this.#numbersOf(draw), group)),
    );
  }

  follow(group: PlaceGroup): void {
    for (const member of this.#members.get(group) ?? []) this.#batch.batches.follow(member);
  }

  leave(group: PlaceGroup): void {
    for (const member of this.#members.get(group) ?? []) this.#batch.batches.remove(member);
    this.#members.delete(group);
  }

  /** It must be one for which `drawnAsOf` is still the same. */
  applyAppearance(appearance: AppearanceDescription, pictures: ShownPictures): void {
    this.#setting = { ...this.#setting, appearance, pictures };
    for (const pick of this.picks) pick.forgetParts();
    const isSame = this.#draws.every(
      ({ ranges: [range], lookKey }) =>
        range && lookKey === lookKeyOf(this.#stage, range, appearance, pictures, this.#batch.batching),
    );
    if (isSame) {
      for (const here of this.#members.values())
        for (const member of here) this.#batch.batches.setLook(member, this.#numbersOf(member.draw));
      return;
    }
    this.#draws = drawsOf(this.#stage, this.#setting, this.#batch);
    for (const group of Array.from(this.#members.keys())) {
      this.leave(group);
      this.hang(group);
    }
  }

  dispose(): void {
    for (const group of Array.from(this.#members.keys())) this.leave(group);
    for (const pick of this.picks) pick.dispose();
  }

  #numbersOf({ request }: BatchedDraw): readonly number[] {
    return this.#batch.batching.numbersOf(request, this.#setting.appearance);
  }
}

function drawsOf(stage: Stage, setting: PatchSetting, { batching, isMerged }: BatchSetting): BatchedDraw[] {
  const { geometry, patch, appearance, pictures, shared } = setting;
  const uniforms = uniformsOf(stage, setting);
  const { sphere: bounds } = boundsOf(geometry, patch, stage);
  const blends = isBlended(stage, appearance, pictures, batching);
  return togetherOf(stage, isMerged, blends).flatMap(({ ranges, mayMerge }) => {
    const [first] = ranges;
    if (first === undefined) return [];
    return [
      {
        stage,
        ranges,
        bounds,
        appearance,
        lookKey: lookKeyOf(stage, first, appearance, pictures, batching),
        isMerged: isMerged && mayMerge,
        isBlended: blends,
        // Files that several shapes share hold more than this stage's.
        vertexCount:
          stage.kind !== "buffers" ? 0 : geometry.container === "bg" ? patch.vertexCount : vertexCountOf(stage),
        shapeFromStored: shapeFromStoredOf(geometry, patch),
        step: storedFrameOf(geometry, patch).step,
        texCoordFrame: [...geometry.texCoordMin, ...geometry.texCoordSize],
        valueFrame: valueFrameOf(stage, geometry.value),
        request: materialRequestOf(stage, first, geometry, uniforms.of(first), shared, true),
        pictures: laidOn(stage, pictures),
      },
    ];
  });
}

/**
 * Draws of one kind of primitive are merged as one. A strip of thin lines would go on into the next, and of wide
 * ones, which have no index, a frame could not tell the order.
 */
function togetherOf(
  { kind, draws }: Stage,
  isMerged: boolean,
  blends: boolean,
): { ranges: readonly DrawRange[]; mayMerge: boolean }[] {
  const seen = draws.filter(isSeen);
  const mayMerge = ({ primitive, isWide }: DrawRange) =>
    isMerged && kind === "buffers" && (isWide === true ? !blends : primitive !== "lineStrip");
  const primitives = new Set(seen.filter(mayMerge).map(({ primitive }) => primitive));
  return [
    ...Array.from(primitives, (primitive) => ({
      ranges: seen.filter((range) => range.primitive === primitive),
      mayMerge: true,
    })),
    ...seen.filter((range) => !mayMerge(range)).map((range) => ({ ranges: [range], mayMerge: false })),
  ];
}

function isSeen({ count }: DrawRange): boolean {
  return count > 0;
}

function isBlended(
  stage: Stage,
  appearance: AppearanceDescription,
  pictures: ShownPictures,
  batching: Batching,
): boolean {
  return batching.isBlended({ colors: colorsOf(stage) }, appearance, laidOn(stage, pictures));
}

/** Without texture coordinates there is nowhere to lay them. */
function laidOn(stage: Stage, pictures: ShownPictures): ShownPictures {
  return stage.texCoord !== undefined ? pictures : noPictures;
}

function lookKeyOf(
  stage: Stage,
  { primitive }: DrawRange,
  appearance: AppearanceDescription,
  pictures: ShownPictures,
  batching: Batching,
): string {
  return batching.keyOf({ primitive, colors: colorsOf(stage) }, appearance, laidOn(stage, pictures));
}

/** The picking pass draws place by place, what the pointer is near. */
function pickOf(stage: Stage, range: DrawRange, settingNow: () => PatchSetting): PickDraw {
  const { geometry, patch, buffers, geometries } = settingNow();
  return new PickDraw(stage, range, {
    buffers,
    bounds: boundsOf(geometry, patch, stage).sphere,
    shapeFromStored: shapeFromStoredOf(geometry, patch),
    makeParts: () => {
      const shape = geometries.acquire(stage)[stage.draws.indexOf(range)];
      if (shape === undefined) throw new RangeError("the draw is not one of its stage");
      return {
        geometry: shape,
        request: pickRequestOf(
          stage,
          range,
          geometry.solid ? FrontSide : DoubleSide,
          uniformsOf(stage, settingNow()).of(range),
          settingNow().appearance,
          settingNow().pictures,
        ),
        release: () => {
          geometries.release(stage);
        },
      };
    },
  });
}
