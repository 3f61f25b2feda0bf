import assert from "node:assert/strict";
import { test } from "node:test";
import { RandomNumbers, EditedDocument } from "../document/edits.testing.ts";
import { elementsOf } from "../document/elements.testing.ts";
import { readScene } from "../document/readScene.ts";
import { sceneScope, numberEffectScopes } from "./effectScope.ts";
import type { SceneInstances } from "./sceneInstances.ts";
import { instancesOf } from "./sceneInstances.ts";
import { InstanceTree } from "./instanceTree.ts";

function instancesIn(markup: string): SceneInstances {
  return instancesOf(readScene(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`)));
}

/** For each light, the ids of the shapes that it lights. */
function litShapes({ lights, shapes }: SceneInstances): string[] {
  return lights.map(({ scope }) =>
    shapes
      .filter(({ effectScope }) => scope.contains(effectScope))
      .map(({ shape }) => shape.element.getAttribute("id"))
      .join(""),
  );
}

test("a directional light lights its group's descendants; a point or spot light lights everything by default", () => {
  const lights = (attributes: string) =>
    `<DirectionalLight ${attributes}/><PointLight ${attributes}/><SpotLight ${attributes}/>`;
  const around = (attributes: string) =>
    `<Shape id="a"/><Group><Shape id="b"/>${lights(attributes)}<Transform><Group><Shape id="c"/></Group></Transform></Group><Shape id="d"/>`;
  assert.deepEqual(litShapes(instancesIn(around(""))), ["bc", "abcd", "abcd"]);
  assert.deepEqual(litShapes(instancesIn(around('global="false"'))), ["bc", "bc", "bc"]);
  assert.deepEqual(litShapes(instancesIn(around('global="true"'))), ["abcd", "abcd", "abcd"]);
});

test("a light at the root lights everything", () => {
  assert.deepEqual(litShapes(instancesIn('<Shape id="a"/><DirectionalLight/><Group><Shape id="b"/></Group>')), ["ab"]);
  assert.equal(instancesIn("<DirectionalLight/>").lights[0]?.scope, sceneScope);
});

test("a USEd light lights each of its groups, and a USEd group is lit by each instance's surroundings", () => {
  const usedTwice =
    '<Group><DirectionalLight DEF="sun"/><Shape id="a"/></Group><Transform><DirectionalLight USE="sun"/><Shape id="b"/></Transform>';
  assert.deepEqual(litShapes(instancesIn(usedTwice)), ["a", "b"]);
  const lit = instancesIn('<Group DEF="G"><Shape id="a"/></Group><Group><DirectionalLight/><Group USE="G"/></Group>');
  assert.deepEqual(litShapes(lit), ["a"]);
  assert.deepEqual(
    lit.shapes.map(({ effectScope }) => effectScope === sceneScope),
    [true, false],
  );
});

test("a light in a Switch choice or a LOD level lights that child only", () => {
  assert.deepEqual(
    litShapes(
      instancesIn(
        '<Switch whichChoice="0"><Group><DirectionalLight/><Shape id="a"/></Group><Shape id="b"/></Switch><Shape id="c"/>',
      ),
    ),
    ["a"],
  );
  assert.deepEqual(
    litShapes(
      instancesIn(
        '<LOD range="1"><Shape id="a"/><Group><DirectionalLight/><Shape id="b"/></Group></LOD><Shape id="c"/>',
      ),
    ),
    ["b"],
  );
});

test("an inlined document is a scope of its own", () => {
  const x3d = elementsOf('<X3D><Scene><DirectionalLight/><Shape id="a"/></Scene></X3D>');
  const page = elementsOf('<X3D><Scene><Inline url="a.x3d"/><Shape id="b"/></Scene></X3D>');
  assert.deepEqual(litShapes(instancesOf(readScene(page, { inlined: () => ({ url: "a.x3d", x3d }) }))), ["a"]);
});

test("scope numbers tell which scope contains which, in random documents", () => {
  let nestedCount = 0;
  for (let seed = 1; seed <= 20; ++seed) {
    const edited = new EditedDocument(new RandomNumbers(seed));
    const tree = new InstanceTree();
    for (let round = 0; round < 10; ++round) {
      edited.edit();
      const { effectScopes: scopes } = tree.update(edited.reader.read().root).root.summary;
      numberEffectScopes(scopes);
      assert.ok(!numberEffectScopes(scopes), "the numbers change only once");
      const all = [sceneScope, ...scopes];
      for (const outer of all) {
        for (const inner of all) {
          const isInside = outer.value <= inner.value && inner.value <= outer.last;
          assert.equal(
            isInside,
            outer.contains(inner),
            `seed ${seed}, round ${round}: ${outer.value} … ${outer.last} and ${inner.value}`,
          );
          if (isInside && outer !== inner && outer !== sceneScope) nestedCount += 1;
        }
      }
    }
  }
  assert.ok(nestedCount > 100, `only ${nestedCount} scopes are inside others`);
});
