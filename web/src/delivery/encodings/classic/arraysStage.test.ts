import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { GpuVertices } from "../../../stage/stage.ts";
import { geometryOf, sigPatch } from "../../delivery.testing.ts";
import { arraysStageOf } from "./arraysStage.ts";
import { AvailableArrays } from "./availableArrays.ts";

const geometry = geometryOf(`<ImageGeometry>${sigPatch(0)}</ImageGeometry>`);
const [patch = assert.fail("no patch")] = geometry.patches;

/** An array of 500 vertices. */
function vertices(components: 2 | 3): GpuVertices {
  const bytes = { byteLength: 500 * 4, close: () => undefined };
  return { bytes, type: "Uint8", components, stride: 4, offset: 0 };
}

function stageWith(arrays: Partial<AvailableArrays>) {
  return arraysStageOf(geometry, patch, Object.assign(new AvailableArrays(), arrays), undefined);
}

const coord = vertices(3);
const normal = vertices(2);
const indexedDraws = { index: undefined, draws: [{ primitive: "triangles", first: 0, count: 600 }] } as const;

describe("the stage of the available arrays", () => {
  test("is none without coordinates", () => {
    assert.equal(stageWith({ attributes: { normal }, indexedDraws }), undefined);
  });

  test("is of all vertices as points before the index is available", () => {
    const stage = stageWith({ coord, coordPlaneCount: 2, attributes: { normal } });
    assert.deepEqual(
      [stage?.name, stage?.vertexCount, stage?.draws],
      ["points", 500, [{ primitive: "points", first: 0, count: 500 }]],
    );
  });

  test("is full when all byte planes of all attributes are available", () => {
    const stageOf = (coordPlaneCount: number, normalPlanes: number) =>
      stageWith({
        coord,
        coordPlaneCount,
        indexedDraws,
        attributes: { normal },
        attributePlaneCounts: { normal: normalPlanes },
      });
    assert.deepEqual([stageOf(2, 1)?.name, stageOf(2, 1)?.draws], ["full", indexedDraws.draws]);
    assert.equal(stageOf(1, 1)?.name, "shaded");
    assert.equal(stageOf(2, 0)?.name, "shaded");
  });

  test("has a grid's own normals before those of its slope", () => {
    const slopeNormals = vertices(3);
    const arrays = { coord, indexedDraws, slopeNormals };
    assert.equal(stageWith(arrays)?.attributes.normal, slopeNormals);
    assert.equal(stageWith(arrays)?.normalFormat.kind, "vector");
    assert.equal(stageWith({ ...arrays, attributes: { normal } })?.attributes.normal, normal);
    assert.equal(stageWith({ ...arrays, attributes: { normal } })?.normalFormat.kind, "byteVector");
  });

  test("has the vertices of a live stream before those of files", () => {
    const streamed = {
      kind: "arrays",
      vertexCount: 500,
      width: 500,
      height: 1,
      coord: vertices(3),
      normal: vertices(2),
      normalFormat: { kind: "octahedral", bits: 16 },
      color: undefined,
      value: undefined,
      byteLength: 4000,
      deriveNormals: () => Promise.resolve(),
    } as const;
    const stage = stageWith({ coord, attributes: { normal, color: coord }, streamed });
    assert.equal(stage?.coord, streamed.coord);
    assert.deepEqual([stage.attributes.normal, stage.attributes.color], [streamed.normal, coord]);
    assert.deepEqual([stage.normalFormat, stage.coordImage], [streamed.normalFormat, undefined]);
  });
});
