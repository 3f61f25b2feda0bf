import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { BudgetRequest } from "./budget.ts";
import { grantedRequests } from "./budget.ts";

interface TestRequest extends BudgetRequest {
  readonly name: string;
  isAllocated: boolean;
}

function request(name: string, bytes: number, priority: number, isAllocated = false, key: unknown = name): TestRequest {
  return { name, key, bytes, priority, isAllocated };
}

function namesOf(chains: readonly (readonly TestRequest[])[], maxBytes: number): string {
  return Array.from(grantedRequests(chains, maxBytes), (granted) => (granted as TestRequest).name)
    .sort()
    .join(" ");
}

describe("within a budget", () => {
  test("all is granted where all fits", () => {
    assert.equal(namesOf([[request("a", 5, 1), request("b", 5, 1)], [request("c", 5, 0)]], 15), "a b c");
  });

  test("the fine stage of the least important shape is dropped first, then its coarse stage", () => {
    const near = [request("near coarse", 10, 1000), request("near fine", 10, 40)];
    const far = [request("far coarse", 10, 100), request("far fine", 10, 4)];
    const behind = [request("behind coarse", 10, 1), request("behind fine", 10, 0.01)];
    const scene = [near, far, behind];
    assert.equal(namesOf(scene, 50), "behind coarse far coarse far fine near coarse near fine");
    assert.equal(namesOf(scene, 40), "far coarse far fine near coarse near fine");
    assert.equal(namesOf(scene, 30), "far coarse near coarse near fine");
    assert.equal(namesOf(scene, 20), "far coarse near coarse");
    assert.equal(namesOf(scene, 10), "near coarse");
    assert.equal(namesOf(scene, 9), "");
  });

  test("nothing is granted without the requests before it in its chain, even if its own priority is larger", () => {
    assert.equal(
      namesOf([[request("points", 10, 1), request("index", 10, 500)], [request("other", 10, 2)]], 15),
      "other",
    );
    assert.equal(namesOf([[request("points", 20, 1), request("index", 5, 500)]], 15), "");
  });

  test("a request that does not fit is skipped for one that does", () => {
    assert.equal(namesOf([[request("large", 100, 9)], [request("small", 10, 1)]], 50), "small");
  });

  test("a file that several patches use counts once", () => {
    const patches = [1, 2, 3].map((n) => [request(`patch ${n}`, 10, 1, false, "file")]);
    assert.equal(namesOf(patches, 10), "patch 1 patch 2 patch 3");
  });

  test("a request of priority 0 is granted while there is room, and dropped first", () => {
    const scene = [[request("unused", 10, 0, true)], [request("used", 10, 0.001)]];
    assert.equal(namesOf(scene, 20), "unused used");
    assert.equal(namesOf(scene, 10), "used");
  });

  test("an allocated request yields only to one of twice its priority", () => {
    assert.equal(namesOf([[request("allocated", 10, 10, true)], [request("other", 10, 19)]], 10), "allocated");
    assert.equal(namesOf([[request("allocated", 10, 10, true)], [request("other", 10, 21)]], 10), "other");
  });

  test("while the view does not change, granted requests stay granted", () => {
    let state = 1;
    const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
    for (let scene = 0; scene < 200; ++scene) {
      const chains = Array.from({ length: 1 + Math.floor(20 * random()) }, (_, chain) =>
        Array.from({ length: 1 + Math.floor(4 * random()) }, (_, index) =>
          request(`${chain}.${index}`, Math.floor(20 * random()), Math.floor(50 * random()), random() < 0.4),
        ),
      );
      const maxBytes = 300 * random();
      let before = grantedRequests(chains, maxBytes);
      for (let turn = 0; turn < 5; ++turn) {
        for (const each of chains.flat()) each.isAllocated = before.has(each);
        const now = grantedRequests(chains, maxBytes);
        for (const each of before)
          assert.ok(now.has(each), `scene ${scene}, turn ${turn}: ${(each as TestRequest).name} is not granted again`);
        before = now;
      }
      const bytes = Array.from(before).reduce((sum, each) => sum + each.bytes, 0);
      assert.ok(bytes <= maxBytes);
    }
  });
});
