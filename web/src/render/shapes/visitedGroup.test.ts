import assert from "node:assert/strict";
import { test } from "node:test";
import { Group, Object3D } from "three";
import { addUnvisited, addVisited, removeVisited, VisitedGroup } from "./visitedGroup.ts";

/** A root with a group, in which there are two groups. */
function makeTree() {
  const root = new Group();
  const [outer, first, second] = [new VisitedGroup(), new VisitedGroup(), new VisitedGroup()];
  addUnvisited(outer, root);
  addUnvisited(first, outer);
  addUnvisited(second, outer);
  return { root, outer, first, second };
}

function visitedOf(root: Object3D): Object3D[] {
  const visited: Object3D[] = [];
  root.traverse((object) => void visited.push(object));
  return visited;
}

test("groups know their parents, and are visited only while something is in them", () => {
  const { root, outer, first, second } = makeTree();
  assert.deepEqual([outer.parent, first.parent, second.parent], [root, outer, outer]);
  assert.deepEqual(visitedOf(root), [root]);
  const [a, b, c] = [new Object3D(), new Object3D(), new Object3D()];
  addVisited(first, [a, b]);
  assert.deepEqual(visitedOf(root), [root, outer, first, a, b]);
  addVisited(second, [c]);
  assert.deepEqual(visitedOf(root), [root, outer, first, a, b, second, c]);
  addVisited(second, []);
  removeVisited(a);
  assert.deepEqual(visitedOf(root), [root, outer, first, b, second, c]);
  removeVisited(b);
  assert.deepEqual(visitedOf(root), [root, outer, second, c]);
  removeVisited(c);
  assert.deepEqual(visitedOf(root), [root]);
  assert.deepEqual([outer.parent, first.parent, second.parent], [root, outer, outer]);
  addVisited(first, [a]);
  assert.deepEqual(visitedOf(root), [root, outer, first, a]);
});

test("a group that leaves takes what is in it along", () => {
  const { root, outer, first } = makeTree();
  const object = new Object3D();
  addVisited(first, [object]);
  removeVisited(first);
  assert.deepEqual(visitedOf(root), [root]);
  assert.equal(outer.parent, root);
  removeVisited(object);
  assert.equal(object.parent, null);
});

test("other groups are children of their parents at all times", () => {
  const [root, group] = [new Group(), new Group()];
  addUnvisited(group, root);
  assert.deepEqual(visitedOf(root), [root, group]);
  const object = new Object3D();
  addVisited(group, [object]);
  removeVisited(object);
  assert.deepEqual(visitedOf(root), [root, group]);
});
