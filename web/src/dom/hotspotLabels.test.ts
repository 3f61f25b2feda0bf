import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { displacedLabels } from "./hotspotLabels.ts";

const label = (name: string, x: number, order: number[], isDisplaced = false) => ({
  name,
  x,
  y: 0,
  width: 100,
  height: 20,
  order,
  isDisplaced,
});
const namesOf = (labels: ReturnType<typeof label>[]) => Array.from(displacedLabels(labels), ({ name }) => name);

describe("labels that overlap", () => {
  test("give way to the one with the first key, and only to labels that are displayed", () => {
    assert.deepEqual(namesOf([label("a", 0, [1, 5]), label("b", 90, [1, 4]), label("c", 180, [1, 6])]), ["a", "c"]);
    assert.deepEqual(namesOf([label("a", 0, [0, 9]), label("b", 90, [1, 4]), label("c", 180, [1, 6])]), ["b"]);
  });

  test("come back only where there is some space", () => {
    assert.deepEqual(namesOf([label("a", 0, [0]), label("b", 102, [1], true)]), ["b"]);
    assert.deepEqual(namesOf([label("a", 0, [0]), label("b", 102, [1])]), []);
    assert.deepEqual(namesOf([label("a", 0, [0]), label("b", 105, [1], true)]), []);
  });

  test("may be thousands, of which few are displayed at once", () => {
    const crowd = Array.from({ length: 5000 }, (_, i) => label(`${i}`, i % 1000, [i]));
    assert.equal(crowd.length - displacedLabels(crowd).size, 10);
  });
});
