import assert from "node:assert/strict";
import { test } from "node:test";
import { TestRandom } from "../decode/compact/rangeEncoder.testing.ts";
import type { GroupBounds } from "./levelIndex.ts";
import { LevelIndex } from "./levelIndex.ts";
import { indexOf, pageCountOf, pagePayload, randomMesh } from "./levels.testing.ts";
import { orthographicView, perspectiveView, randomView } from "./levelViews.testing.ts";
import { errorAround, errorInPixels } from "./projectedError.ts";

const { levels } = randomMesh(2, 2000, 10);
const index = indexOf(levels);
function boundsOf(group: number): GroupBounds {
  const bounds = { x: 0, y: 0, z: 0, radius: 0, reach: 0, error: 0 };
  index.readBounds(group, bounds);
  return bounds;
}
const groups = Array.from({ length: index.groupCount }, (_, group) => group).slice(index.rootCount);
const ownIndex = indexOf({ ...levels, hasOwnSpheres: true });

test("errors on the screen nest in every view, in and out of the frustum", () => {
  const random = new TestRandom(3);
  for (let n = 0; n < 200; ++n) {
    const measure = errorInPixels(index, [randomView(random)]);
    for (const group of groups)
      for (const parent of index.parents(group))
        assert.ok(measure(parent) > measure(group), `view ${n}: group ${group} exceeds its parent ${parent}`);
  }
});

test("with spheres of groups alone errors nest, and are at most those of spheres that nest", () => {
  const random = new TestRandom(4);
  let smaller = 0;
  for (let n = 0; n < 200; ++n) {
    const view = randomView(random);
    const [nested, measure] = [errorInPixels(index, [view]), errorInPixels(ownIndex, [view])];
    for (const group of groups) {
      assert.ok(measure(group) <= nested(group) * 1.000001, `view ${n}: group ${group} has ${measure(group)}`);
      for (const parent of ownIndex.parents(group))
        assert.ok(measure(parent) >= measure(group), `view ${n}: group ${group} exceeds its parent ${parent}`);
      if (measure(group) < 0.9 * nested(group)) ++smaller;
    }
  }
  assert.ok(smaller > 500, `${smaller} errors are smaller`);
});

test("a group's reach contains the spheres of all groups below, whatever the order of pages", () => {
  const own = { ...levels, hasOwnSpheres: true };
  const late = new LevelIndex(pagePayload(own, 0));
  for (let page = pageCountOf(own) - 1; page > 0; --page) late.addPage(page, pagePayload(own, page));
  const [outer, inner] = [boundsOf(0), boundsOf(0)];
  for (let group = 0; group < late.groupCount; ++group) {
    late.readBounds(group, outer);
    assert.ok(outer.reach >= outer.radius);
    for (const child of late.children(group)) {
      late.readBounds(child, inner);
      const distance = Math.hypot(outer.x - inner.x, outer.y - inner.y, outer.z - inner.z);
      assert.ok(outer.reach >= (distance + inner.reach) * 0.999999, `group ${child} reaches out of ${group}`);
    }
  }
});

test("an error in the middle of the view has its size at the nearest point of the sphere", () => {
  const group = groups.at(-1)!;
  const { x, y, z, radius, error } = boundsOf(group);
  const at = (distance: number) => errorInPixels(index, [perspectiveView([x, y, z + distance], { near: 2 })])(group);
  assert.ok(Math.abs(at(radius + 500) - (error * 1000) / 500) < 1e-9);
  assert.equal(at(radius / 2), (error * 1000) / 2, "inside of the sphere the near plane counts");
});

test("no group is nearer than the bounds of the mesh", () => {
  const eye = [30000, 40000, 165535] as const;
  const view = perspectiveView(eye, {});
  const measure = errorInPixels(index, [view]);
  const ofSpheres = errorInPixels(index, [{ ...view, box: { min: eye, max: eye } }]);
  let smaller = 0;
  for (const group of groups) {
    const { x, y, z, radius, error } = boundsOf(group);
    const distance = Math.hypot(x - eye[0], y - eye[1], z - eye[2]) - radius;
    if (ofSpheres(group) < (error * 1000) / Math.max(distance, 1) / 1.000001) continue; // out of the frustum
    assert.ok(Math.abs(measure(group) - (error * 1000) / Math.max(distance, 100000)) < 1e-9);
    if (distance < 100000) ++smaller;
  }
  assert.ok(smaller > 0, "no sphere reaches out of the mesh");
});

test("the instance's transform scales sphere and error", () => {
  const eye = [70000, 40000, 90000] as const;
  const scaled = perspectiveView([7, 4, 9], { near: 1e-4, scale: 1e-4 });
  const view = perspectiveView(eye, { near: 1 });
  for (const group of groups) {
    const [a, b] = [errorInPixels(index, [view])(group), errorInPixels(index, [scaled])(group)];
    assert.ok(Math.abs(a - b) <= 1e-9 * a, `${a} ${b}`);
  }
});

test("roots have an infinite error, and of several views the largest counts", () => {
  const random = new TestRandom(5);
  const [a, b] = [randomView(random), randomView(random)];
  const both = errorInPixels(index, [a, b]);
  assert.equal(both(0), Infinity);
  assert.equal(errorInPixels(index, [])(0), Infinity);
  assert.equal(errorInPixels(index, [])(groups[0]!), 0);
  for (const group of groups)
    assert.equal(both(group), Math.max(errorInPixels(index, [a])(group), errorInPixels(index, [b])(group)));
});

test("beside the frustum the error falls continuously to a hundredth", () => {
  const group = groups.at(-1)!;
  const { x, y, z } = boundsOf(group);
  for (const isOrthographic of [false, true]) {
    const values: number[] = [];
    for (let angle = 0; angle <= Math.PI; angle += 0.00005) {
      const direction = [Math.sin(angle), 0, Math.cos(angle)] as const;
      const eye = [x, y, z + 100000] as const;
      const make = isOrthographic ? orthographicView : perspectiveView;
      const moved = isOrthographic ? ([eye[0] + angle * 200000, eye[1], eye[2]] as const) : eye;
      values.push(errorInPixels(index, [make(moved, { direction: isOrthographic ? [0, 0, 1] : direction })])(group));
    }
    const [first, last] = [values[0]!, values.at(-1)!];
    assert.ok(Math.abs(first / last - 100) < 1e-6, `${first / last}`);
    for (const [n, value] of values.entries()) {
      const before = values[n - 1] ?? value;
      assert.ok(value <= before * 1.000001 && value > before * 0.85, `${n}: ${before} to ${value}`);
    }
  }
});

test("an orthographic camera sees the same error at every distance", () => {
  const group = groups.at(-1)!;
  const { x, y } = boundsOf(group);
  const at = (z: number) => errorInPixels(index, [orthographicView([x, y, z], {})])(group);
  assert.equal(at(1e5), at(1e6));
  assert.ok(at(1e5) > 0);
});

test("errors around a point nest, and are above every tolerance where a sphere contains it, also out of all views", () => {
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const { x, y, z } = boundsOf(groups.at(-1)!);
  for (const views of [[], [perspectiveView([x, y, z + 1e9], { direction: [0, 0, -1] })]]) {
    const plain = errorInPixels(index, views);
    const measure = errorAround(plain, index, [identity], [x, y, z]);
    for (const group of groups) {
      const bounds = boundsOf(group);
      const isAround = Math.hypot(bounds.x - x, bounds.y - y, bounds.z - z) <= bounds.radius;
      assert.ok(isAround ? measure(group) >= 1e6 : measure(group) === plain(group));
      for (const parent of index.parents(group)) assert.ok(measure(parent) >= measure(group));
    }
    assert.ok(groups.some((group) => measure(group) === plain(group)));
  }
});
