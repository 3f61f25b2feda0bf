import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { BudgetRequest } from "./budget.ts";
import { grantedRequests } from "./budget.ts";

interface TestClaim extends BudgetRequest {
  readonly name: string;
  isAllocated: boolean;
}

function claim(name: string, bytes: number, priority: number, isHeld = false, key: unknown = name): TestClaim {
  return { name, key, bytes, priority, isAllocated: isHeld };
}

function namesOf(chains: readonly (readonly TestClaim[])[], mostBytes: number): string {
  return Array.from(grantedRequests(chains, mostBytes), (granted) => (granted as TestClaim).name)
    .sort()
    .join(" ");
}

describe("within a budget", () => {
  test("all is granted where all fits", () => {
    assert.equal(namesOf([[claim("a", 5, 1), claim("b", 5, 1)], [claim("c", 5, 0)]], 15), "a b c");
  });

  test("the finer part of the less important goes first, then all of it", () => {
    const near = [claim("near coarse", 10, 1000), claim("near fine", 10, 40)];
    const far = [claim("far coarse", 10, 100), claim("far fine", 10, 4)];
    const behind = [claim("behind coarse", 10, 1), claim("behind fine", 10, 0.01)];
    const scene = [near, far, behind];
    assert.equal(namesOf(scene, 50), "behind coarse far coarse far fine near coarse near fine");
    assert.equal(namesOf(scene, 40), "far coarse far fine near coarse near fine");
    assert.equal(namesOf(scene, 30), "far coarse near coarse near fine");
    assert.equal(namesOf(scene, 20), "far coarse near coarse");
    assert.equal(namesOf(scene, 10), "near coarse");
    assert.equal(namesOf(scene, 9), "");
  });

  test("nothing is granted without what it builds upon, even if an author wants it first", () => {
    assert.equal(namesOf([[claim("points", 10, 1), claim("index", 10, 500)], [claim("other", 10, 2)]], 15), "other");
    assert.equal(namesOf([[claim("points", 20, 1), claim("index", 5, 500)]], 15), "");
  });

  test("what does not fit is passed over for what does", () => {
    assert.equal(namesOf([[claim("large", 100, 9)], [claim("small", 10, 1)]], 50), "small");
  });

  test("a file that several patches use takes its room once", () => {
    const patches = [1, 2, 3].map((n) => [claim(`patch ${n}`, 10, 1, false, "file")]);
    assert.equal(namesOf(patches, 10), "patch 1 patch 2 patch 3");
  });

  test("what nobody wants now is the first to go, and stays while there is room", () => {
    const scene = [[claim("unwanted", 10, 0, true)], [claim("wanted", 10, 0.001)]];
    assert.equal(namesOf(scene, 20), "unwanted wanted");
    assert.equal(namesOf(scene, 10), "wanted");
  });

  test("what is held gives way only to what matters twice as much", () => {
    assert.equal(namesOf([[claim("held", 10, 10, true)], [claim("other", 10, 19)]], 10), "held");
    assert.equal(namesOf([[claim("held", 10, 10, true)], [claim("other", 10, 21)]], 10), "other");
  });

  test("a view that stands still comes to rest: what has been granted stays", () => {
    let state = 1;
    const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
    for (let scene = 0; scene < 200; ++scene) {
      const chains = Array.from({ length: 1 + Math.floor(20 * random()) }, (_, chain) =>
        Array.from({ length: 1 + Math.floor(4 * random()) }, (_, part) =>
          claim(`${chain}.${part}`, Math.floor(20 * random()), Math.floor(50 * random()), random() < 0.4),
        ),
      );
      const mostBytes = 300 * random();
      let before = grantedRequests(chains, mostBytes);
      for (let turn = 0; turn < 5; ++turn) {
        for (const each of chains.flat()) each.isAllocated = before.has(each);
        const now = grantedRequests(chains, mostBytes);
        for (const each of before)
          assert.ok(now.has(each), `scene ${scene}, turn ${turn}: ${(each as TestClaim).name} goes to and fro`);
        before = now;
      }
      const bytes = Array.from(before).reduce((sum, each) => sum + each.bytes, 0);
      assert.ok(bytes <= mostBytes);
    }
  });
});
