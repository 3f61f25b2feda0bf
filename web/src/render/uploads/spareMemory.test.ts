import assert from "node:assert/strict";
import { describe, mock, test } from "node:test";
import { SpareMemory } from "./spareMemory.ts";

function makeSpare() {
  const freed: string[] = [];
  return { freed, spare: new SpareMemory<string>((name) => freed.push(name)) };
}

describe("spare memory", () => {
  test("frees at once what is released while nothing is replaced", () => {
    const { freed, spare } = makeSpare();
    spare.release("4", "a");
    assert.deepEqual(freed, ["a"]);
    assert.equal(spare.take("4"), undefined);
  });

  test("gives what is released to the next that has the same size, once", () => {
    const { freed, spare } = makeSpare();
    spare.expectReplacements();
    spare.release("4", "a");
    assert.equal(spare.take("8"), undefined);
    assert.equal(spare.take("4"), "a");
    assert.equal(spare.take("4"), undefined);
    spare.release("4", "b");
    spare.clear();
    assert.deepEqual(freed, ["b"]);
  });

  test("frees what nobody has taken two seconds after the last replacement", () => {
    mock.timers.enable({ apis: ["setTimeout"] });
    try {
      const { freed, spare } = makeSpare();
      spare.expectReplacements();
      spare.release("4", "a");
      mock.timers.tick(1500);
      spare.expectReplacements();
      mock.timers.tick(1500);
      assert.deepEqual(freed, []);
      mock.timers.tick(500);
      assert.deepEqual(freed, ["a"]);
      spare.release("4", "b");
      assert.deepEqual(freed, ["a", "b"]);
    } finally {
      mock.timers.reset();
    }
  });
});
