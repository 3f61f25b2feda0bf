import assert from "node:assert/strict";
import { test } from "node:test";
import { sceneLabelOf } from "./sceneLabel.ts";

function elementWith(attributes: Readonly<Record<string, string>>): Pick<Element, "getAttribute"> {
  return { getAttribute: (name) => attributes[name] ?? null };
}

/** An <x3d> with these attributes and the WorldInfo's title. */
function x3dOf(attributes: Readonly<Record<string, string>>, title?: string): Parameters<typeof sceneLabelOf>[0] {
  const found = { querySelector: () => (title === undefined ? null : elementWith({ title })) };
  return { ...elementWith(attributes), ...found } as Parameters<typeof sceneLabelOf>[0];
}

test("the label of a scene is its first text of alt, aria-label, title, WorldInfo and the documents it inlines", () => {
  const attributes = { "aria-label": "the label", title: "the title" };
  const x3d = x3dOf(attributes, "the WorldInfo");
  assert.equal(sceneLabelOf(x3d, "the alt", "the Inline"), "the alt");
  assert.equal(sceneLabelOf(x3d, "", "the Inline"), "the label");
  assert.equal(sceneLabelOf(x3dOf({ ...attributes, "aria-label": "" }), "", "the Inline"), "the title");
  assert.equal(sceneLabelOf(x3dOf({}, "the WorldInfo"), "", "the Inline"), "the WorldInfo");
  assert.equal(sceneLabelOf(x3dOf({}, ""), "", "the Inline"), "the Inline");
  assert.equal(sceneLabelOf(x3dOf({}), "", undefined), "3D scene");
});
