import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { navigationTypesOf } from "./navigationType.ts";

describe("the allowed navigation types", () => {
  for (const [names, first, allowed] of [
    [["EXAMINE", "ANY"], "examine", ["examine", "walk", "fly"]],
    [["WALK"], "walk", ["walk"]],
    [["fly", "walk"], "fly", ["fly", "walk"]],
    [["NONE"], "none", ["none"]],
    [["NONE", "ANY"], "none", ["none", "examine", "walk", "fly"]],
    [["TURNTABLE"], "examine", ["examine"]],
    [["SWIM"], "examine", ["examine", "walk", "fly"]],
    [[], "examine", ["examine", "walk", "fly"]],
  ] as const) {
    test(`of "${names.join(" ")}" are ${allowed.join(", ")}, and the initial one is ${first}`, () => {
      const types = navigationTypesOf(names);
      assert.deepEqual([types.first, types.allowed], [first, allowed]);
    });
  }
});
