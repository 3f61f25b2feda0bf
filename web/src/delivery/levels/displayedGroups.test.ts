import assert from "node:assert/strict";
import { test } from "node:test";
import type { GeometryDescription } from "../../document/description.ts";
import { TestRandom } from "../../decode/compact/rangeEncoder.testing.ts";
import { chooseCut, groupMemory } from "../../levels/cut.ts";
import { illegalityOf, indexOf, randomMesh } from "../../levels/levels.testing.ts";
import type { TestMesh } from "../../levels/levels.testing.ts";
import { perspectiveView, randomView } from "../../levels/levelViews.testing.ts";
import { expectedBytesPerVertex } from "../../levels/meshMemory.ts";
import { errorInPixels } from "../../levels/projectedError.ts";
import type { BufferStage } from "../../stage/stage.ts";
import { geometryOf } from "../delivery.testing.ts";
import { DisplayedGroups } from "./displayedGroups.ts";
import type { StoredGroup } from "./storedGroup.ts";

const bytesPerVertex = 20;
const noLimit = 1e9;
const geometry = geometryOf(
  '<ImageGeometry profile="compact" positionBits="16" levels="levels.png" position="0 0 0" size="2 2 2"/>',
);

/** What a test's group draws: those of its children that were closed when the stage was made. */
interface DrawnStage {
  readonly name: string;
  readonly closed: readonly number[];
}

/** A mesh whose groups have no buffers, and what is displayed of it. */
class TestDisplay {
  readonly mesh: TestMesh;
  readonly groups: DisplayedGroups;
  readonly drawn = new Map<number, DrawnStage>();
  readonly freed: number[] = [];
  drawnGeometry: GeometryDescription | undefined;
  #now = 0;

  constructor(seed: number) {
    this.mesh = randomMesh(seed, 600, 10);
    const whole = geometry.patches[0] ?? assert.fail();
    const index = indexOf(this.mesh.levels);
    this.groups = new DisplayedGroups(geometry, whole, index, {
      onStage: (group, stage, drawnGeometry) => {
        this.drawnGeometry = drawnGeometry;
        if (stage === undefined) this.drawn.delete(group);
        else this.drawn.set(group, stage as unknown as DrawnStage);
      },
    });
  }

  add(group: number): void {
    const { index } = this.groups;
    const stage: StoredGroup["stage"] = (name, children, open) =>
      // The stage of a group without buffers: only what this test compares.
      ({ kind: "buffers", name, closed: children.filter((child) => !open.has(child)) }) as unknown as BufferStage;
    const close = (): void => {
      assert.ok(!this.drawn.has(group), `group ${group} is freed while a stage draws it`);
      this.freed.push(group);
    };
    this.groups.add(group, { byteLength: groupMemory({ index, bytesPerVertex }, group), stage, close });
  }

  /** Makes the groups of a cut open, and after a delay all others closed. */
  show(target: ReadonlySet<number>): void {
    for (const group of target) if (!this.groups.has(group)) this.add(group);
    for (let n = 0; n < 2; ++n) this.groups.approach(target, (this.#now += 2000), 1000);
  }

  /** Whether each open group draws what its open children do not. */
  check(): void {
    const { open, index } = this.groups;
    assert.equal(illegalityOf(this.mesh.levels, open), undefined);
    assert.deepEqual([...this.drawn.keys()].sort(), [...open].sort());
    for (const [group, { closed }] of this.drawn)
      assert.deepEqual(
        closed,
        [...index.children(group)].filter((child) => !open.has(child)),
      );
  }
}

/** The cut for a view, within a budget of bytes. */
function cutFor(display: TestDisplay, view: ReturnType<typeof randomView>, budget = noLimit): ReadonlySet<number> {
  const { index, open } = display.groups;
  const mesh = { index, errorInPixels: errorInPixels(index, [view]), open, absent: new Set<number>(), bytesPerVertex };
  return chooseCut([mesh], { tolerance: 0.02, budget }).meshes[0]?.target ?? assert.fail();
}

test("open groups draw what their open children do not, while cuts follow cameras that jump", () => {
  let largest = 0;
  for (let seed = 0; seed < 8; ++seed) {
    const random = new TestRandom(seed);
    const display = new TestDisplay(seed);
    for (let n = 0; n < 10; ++n) {
      const target = cutFor(display, randomView(random));
      display.show(target);
      display.check();
      assert.deepEqual(new Set(display.groups.open), target);
      largest = Math.max(largest, target.size);
      for (const group of target) assert.ok(display.drawnGeometry?.patches[group], `group ${group} is a patch`);
    }
  }
  assert.ok(largest > 20, `${largest} groups`);
});

test("groups that leave the GPU are freed after the stages that drew them, and returned", () => {
  const random = new TestRandom(3);
  const display = new TestDisplay(3);
  const { groups } = display;
  display.show(cutFor(display, randomView(random)));
  const before = groups.bytes;
  const needed = cutFor(display, randomView(random), before / 3);
  const freed = groups.makeRoom(before / 2, needed);
  display.check();
  assert.ok(freed.length > 0 && groups.bytes < before);
  assert.deepEqual(display.freed, freed);
  for (const group of freed) assert.ok(!groups.has(group) && !needed.has(group));
  display.drawn.clear(); // as no stage is drawn after `close`
  const others = [...display.mesh.levels.groups.keys()].filter((group) => groups.has(group));
  display.freed.length = 0;
  groups.close();
  assert.deepEqual(display.freed.sort(), others.sort());
});

test("memory is that of the groups, and a vertex has that of the groups' vertices", () => {
  const display = new TestDisplay(5);
  const { groups } = display;
  assert.deepEqual([groups.bytes, groups.bytesPerVertex], [0, expectedBytesPerVertex]);
  const added = [0, 1, 2];
  for (const group of added) display.add(group);
  const memory = added.map((group) => groupMemory({ index: groups.index, bytesPerVertex }, group));
  assert.equal(
    groups.bytes,
    memory.reduce((sum, bytes) => sum + bytes, 0),
  );
  assert.equal(groups.bytesPerVertex, bytesPerVertex);
});

test("the root is the base of what follows until a view has all that it needs", () => {
  const display = new TestDisplay(7);
  display.show(new Set([0]));
  assert.equal(display.drawn.get(0)?.name, "base");
  display.groups.complete();
  assert.equal(display.drawn.get(0)?.name, "full");
  display.show(cutFor(display, randomView(new TestRandom(7))));
  assert.equal(display.drawn.get(0)?.name, "full");
});

test("the stated error is that of the coarsest form that is drawn, and 0 where none is", () => {
  const display = new TestDisplay(9);
  const { groups, mesh } = display;
  const view = perspectiveView([32768, 32768, 60_000], {});
  const measure = errorInPixels(groups.index, [view]);
  assert.equal(groups.statistics(measure).errorInPixels, 0, "nothing is drawn");
  display.show(new Set([0]));
  const children = [...groups.index.children(0)];
  assert.equal(groups.statistics(measure).errorInPixels, Math.max(...children.map(measure)));
  display.show(new Set(mesh.levels.groups.keys()));
  const { groups: count, openGroups, errorInPixels: error } = groups.statistics(measure);
  assert.deepEqual([count, openGroups, error], [mesh.levels.groups.length, mesh.levels.groups.length, 0]);
});
