import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { readSequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import { geometryOf, sigPatch } from "../delivery.testing.ts";
import { frameDescriptionOf, framesGeometryOf } from "./framesGeometry.ts";

const file = join(import.meta.dirname, "../../../../vectors/sequence-1/points.index.json");
const index = {
  ...readSequenceIndex(Uint8Array.from(readFileSync(file))),
  valueComponents: 1,
  valueName: "pressure",
} as const;
const geometry = geometryOf(`<ImageGeometry>${sigPatch(0)}</ImageGeometry>`);

describe("the geometry of a sequence's frames", () => {
  test("has the frames as its only coordinates, and no normals in files; its index stays", () => {
    const { encoding, patches } = framesGeometryOf(geometry, "frames.json");
    assert.equal(encoding, "live");
    assert.deepEqual(patches[0], {
      ...geometry.patches[0],
      coord: [{ url: "frames.json", firstTexel: 0 }],
      normal: undefined,
    });
  });

  test("has the frames' values where they are the attribute that colours the shape, or where there is none", () => {
    const value = { name: "pressure", components: 1, fileCount: 1, bits: 8, min: [0], size: [1] } as const;
    assert.equal(frameDescriptionOf(geometry, index).valueComponents, 1);
    assert.equal(frameDescriptionOf({ ...geometry, value }, index).valueComponents, 1);
    const other = { ...value, name: "temperature" };
    assert.deepEqual(frameDescriptionOf({ ...geometry, value: other }, index), { ...index, valueComponents: 0 });
  });
});
