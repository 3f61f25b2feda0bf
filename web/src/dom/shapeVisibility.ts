// Which shapes of a scene are visible, by name; hotspots hide with their shape.

import type { NodeDescription, SceneDescription } from "../document/description.ts";
import { attributeOf } from "../document/element.ts";

export class ShapeVisibility {
  /** The shapes of `scene`, listed when one is asked for. */
  #listed: { readonly scene: SceneDescription; readonly byName: ReadonlyMap<string, boolean> } | undefined;

  /** Whether an instance of the shape with this DEF or id is visible; undefined if there is no such shape. */
  isVisible(scene: SceneDescription, name: string): boolean | undefined {
    if (this.#listed?.scene !== scene) this.#listed = { scene, byName: visibilityByName(scene.root) };
    return this.#listed.byName.get(name);
  }
}

/** Whether the shapes with a DEF or an id are visible. */
function visibilityByName(root: NodeDescription): Map<string, boolean> {
  const byName = new Map<string, boolean>();
  const add = (node: NodeDescription): void => {
    if (node.kind === "group") node.children.forEach(add);
    if (node.kind !== "shape") return;
    for (const attribute of ["DEF", "id"]) {
      const name = attributeOf(node.element, attribute);
      if (name !== undefined) byName.set(name, node.visible || byName.get(name) === true);
    }
  };
  add(root);
  return byName;
}
