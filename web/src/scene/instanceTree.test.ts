import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { SceneElement } from "../document/element.ts";
import { elementsOf } from "../document/elements.testing.ts";
import { readScene } from "../document/readScene.ts";
import { InstanceTree } from "./instanceTree.ts";
import type { NodeInstance } from "./nodeInstance.ts";

/** The ids of shapes with their x in the scene, in document order. */
function positionsOf(node: NodeInstance): string[] {
  const own =
    node.description.kind === "shape"
      ? [`${node.description.element.getAttribute("id") ?? ""} ${node.sceneFromNode.elements[12]}`]
      : [];
  return [...own, ...node.children.flatMap(positionsOf)];
}

function sceneOf(markup: string): SceneElement {
  return elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`);
}

function transformsIn(element: SceneElement): SceneElement[] {
  const own = element.localName.toLowerCase() === "transform" ? [element] : [];
  return [...own, ...Array.from(element.children).flatMap(transformsIn)];
}

/** Moves Transforms in this order: the first to x = 10 · round, the second to 10 · round + 1 … */
function moveAll(tree: InstanceTree, transforms: readonly SceneElement[], round: number): void {
  tree.move(transforms.map((element, n) => ({ element, field: "translation", value: [10 * round + n, 0, 0] })));
}

describe("Transforms that move in every frame", () => {
  const shape = (id: string) => `<Transform><Shape id="${id}"/></Transform>`;

  test("move in the same order, and in another one", () => {
    const scene = sceneOf(shape("a") + shape("b") + shape("c"));
    const tree = new InstanceTree().update(readScene(scene).root);
    const transforms = transformsIn(scene);
    moveAll(tree, transforms, 1);
    moveAll(tree, transforms, 2);
    assert.deepEqual(positionsOf(tree.root), ["a 20", "b 21", "c 22"]);
    moveAll(tree, transforms.toReversed(), 3);
    assert.deepEqual(positionsOf(tree.root), ["a 32", "b 31", "c 30"]);
    moveAll(tree, transforms.slice(1), 4);
    assert.deepEqual(positionsOf(tree.root), ["a 32", "b 40", "c 41"]);
  });

  test("move with all their instances, also after instances have been added and removed", () => {
    const defined = '<Transform DEF="T"><Shape id="a"/></Transform>';
    const once = sceneOf(defined + shape("b"));
    const tree = new InstanceTree().update(readScene(once).root);
    moveAll(tree, transformsIn(once), 1);
    assert.deepEqual(positionsOf(tree.root), ["a 10", "b 11"]);

    const twice = sceneOf(`${defined}${shape("b")}<Transform USE="T"/>`);
    tree.update(readScene(twice).root);
    const [first, second] = transformsIn(twice);
    assert.ok(first && second);
    moveAll(tree, [first, second], 2);
    moveAll(tree, [first, second], 3);
    assert.deepEqual(positionsOf(tree.root), ["a 30", "b 31", "a 30"]);

    tree.update(readScene(once).root);
    moveAll(tree, [first, second], 4); // they have left
    const rest = positionsOf(tree.root);
    assert.ok(!rest.includes("a 40") && !rest.includes("b 41"));
    moveAll(tree, transformsIn(once), 5);
    assert.deepEqual(positionsOf(tree.root), ["a 50", "b 51"]);
  });
});
