// What the shader programs of shapes will be, from their document alone. They are
// compiled while the first files are on their way: a driver takes a good part of a
// second for them, and a page that draws with a program that is not ready waits.

import { BufferAttribute, BufferGeometry, type Object3D, Texture } from "three";
import type { BufferStage, DrawRange, Stage, StoredVertices, TexelRange, TextureStage } from "../../stage/stage.ts";
import type { GeometryDescription, PatchDescription, ShapeDescription } from "../../document/description.ts";
import { isPair } from "../../document/geometry.ts";
import { drawnAsOf } from "../batches/batchedStage.ts";
import type { DrawingPlan } from "../batches/batchingPlan.ts";
import { objectOf } from "./drawnObject.ts";
import type { Look, SceneUniforms, ShownPicture } from "../materials/materialFactory.ts";
import { noPictures } from "../materials/materialFactory.ts";
import { materialRequestOf } from "./stageDraws.ts";
import { withWideLines } from "../lines/wideLines.ts";

const nowhere: TexelRange = { image: { width: 1, height: 1, close: () => undefined }, first: 0 };
const noPicture: ShownPicture = { texture: new Texture(), hasAlpha: false };

/**
 * An object for each program, by what makes it differ from others. Of images on the GPU, and of what stands in
 * for patches of compact: other buffers need no less, but tell it later.
 */
export function objectsToCome(
  shapes: Iterable<ShapeDescription>,
  plan: DrawingPlan,
  look: Look,
  shared: SceneUniforms,
): Map<string, Object3D> {
  const objects = new Map<string, Object3D>();
  const bare = new BufferGeometry();
  // Programs differ by what is in buffers.
  const one = new BufferAttribute(new Int8Array(3), 3);
  const inBuffers = new BufferGeometry().setAttribute("position", one).setAttribute("normal", one);
  for (const { geometry: described, appearance, visible } of shapes) {
    if (described === undefined || !visible) continue;
    const {
      textures,
      material: { kind, transparency },
      alpha,
      lines,
    } = appearance;
    const pictures = new Map(textures.map(({ role }) => [role, noPicture]));
    for (const bareStage of stagesToCome(described, textures.length > 0)) {
      const stage = lines ? withWideLines(bareStage) : bareStage;
      for (const range of stage.draws) {
        const laid = stage.texCoord !== undefined ? pictures : noPictures;
        const isBatched =
          look.batching !== undefined &&
          drawnAsOf(stage, plan.drawingOf(described), appearance, laid, look.batching) !== "alone";
        const request = materialRequestOf(stage, range, described, {}, shared, isBatched);
        const key = JSON.stringify([{ ...request, shared: undefined }, kind, transparency > 0, alpha, ...laid.keys()]);
        if (objects.has(key)) continue;
        const geometry = stage.kind === "buffers" ? inBuffers : bare;
        objects.set(key, objectOf(range, geometry, look.makeMaterial(request, appearance, laid)));
      }
    }
  }
  return objects;
}

/** Patches of one geometry hardly differ; the first speaks for all. */
function stagesToCome(geometry: GeometryDescription, isTextured: boolean): Stage[] {
  const [patch] = geometry.patches;
  if (geometry.base !== undefined) return [baseToCome];
  if (patch === undefined || patch.coord.length === 0 || geometry.container !== "sig" || geometry.decode === "cpu")
    return [];
  const surface: TextureStage = {
    ...bareStage(geometry, patch),
    name: "surface",
    draws: patch.draws.map(drawn),
    index: patch.index && nowhere,
  };
  const stages: Stage[] = [surface];
  if (patch.index !== undefined)
    stages.push({ ...surface, name: "points", draws: [{ primitive: "points", first: 0, count: 1 }], index: undefined });
  let stage = surface;
  const add = (part: "normal" | "texCoord" | "color", isThere: boolean) => {
    if (!isThere) return;
    stage = { ...stage, name: "shaded", [part]: nowhere };
    stages.push(stage);
  };
  add("normal", patch.normal !== undefined);
  add("texCoord", isTextured && patch.texCoord !== undefined);
  add("color", patch.color !== undefined);
  return stages;
}

const nowhereStored: StoredVertices = {
  bytes: { byteLength: 0, close: () => undefined },
  type: "Int8",
  components: 3,
  stride: 4,
  offset: 0,
};

/** Without the colours that a base may have too. */
const baseToCome: BufferStage = {
  kind: "buffers",
  name: "base",
  draws: [{ primitive: "triangles", first: 0, count: 1 }],
  index: undefined,
  coord: nowhereStored,
  normal: nowhereStored,
  normalCode: { kind: "vector" },
  color: undefined,
  value: undefined,
  texCoord: undefined,
};

function drawn({ primitive }: PatchDescription["draws"][number]): DrawRange {
  return { primitive, first: 0, count: 1 };
}

function bareStage(
  { normalEncoding, indexType, colorComponents }: GeometryDescription,
  patch: PatchDescription,
): Omit<TextureStage, "name" | "draws" | "index"> {
  return {
    kind: "textures",
    grid: patch.grid,
    isIndexWide: indexType === "Uint32",
    implicitWidth: patch.implicitWidth,
    coord: [nowhere],
    coordPlanes: patch.coord.length,
    middleOfMissing: 0,
    normal: undefined,
    normalCode: isPair(normalEncoding) ? { kind: normalEncoding, bits: 8 } : { kind: "byteVector" },
    color: undefined,
    colorComponents,
    texCoord: undefined,
    value: undefined,
  };
}
