import assert from "node:assert/strict";
import { test } from "node:test";
import { elementsOf } from "../document/elements.testing.ts";
import { minBatchedInstances } from "../document/parts.ts";
import { readScene } from "../document/readScene.ts";
import { partsToDisplay } from "./partsToDisplay.ts";

function partsOf(markup: string): readonly string[] {
  return partsToDisplay(readScene(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`)));
}

const shape = "<Shape><ImageGeometry></ImageGeometry></Shape>";

test("a statue needs no part to be displayed", () => {
  assert.deepEqual(partsOf(shape), []);
});

test("many instances need batches, hidden ones included", () => {
  assert.deepEqual(partsOf(shape.repeat(minBatchedInstances - 1)), []);
  assert.deepEqual(partsOf(`<Group visible='false'>${shape.repeat(minBatchedInstances)}</Group>`), ["batches"]);
});

test("a fog needs the environment, and a navigation that begins with WALK walking", () => {
  assert.deepEqual(partsOf(`<Fog visibilityRange='5'></Fog>${shape}`), ["environment"]);
  assert.deepEqual(partsOf(`<NavigationInfo type='"WALK" "ANY"'></NavigationInfo>${shape}`), ["walking"]);
  assert.deepEqual(partsOf(`<NavigationInfo type='"EXAMINE" "WALK"'></NavigationInfo>${shape}`), []);
});
