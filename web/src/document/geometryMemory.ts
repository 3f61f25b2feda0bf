// What has been read of geometry elements, kept from one reading of the document
// to the next: a geometry that did not change, and one that several shapes USE,
// is one and the same object, so that comparing geometries is comparing objects.

import { withValues } from "./attributes.ts";
import type { GeometryDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";

export class GeometryMemory {
  readonly #known = new WeakMap<SceneElement, GeometryDescription>();
  readonly #withValues = new WeakMap<GeometryDescription, Map<string, GeometryDescription>>();
  #touched = new WeakSet<SceneElement>();

  /** Says that the element, or something in it, may have changed. */
  touch(element: SceneElement): void {
    this.#touched.add(element);
  }

  /** What `read` makes of the element, which is called only where that is not known; undefined for what is no geometry. */
  recall(element: SceneElement, read: () => GeometryDescription | undefined): GeometryDescription | undefined {
    const known = this.#known.get(element);
    if (known !== undefined && !this.#touched.delete(element)) return known;
    const fresh = read();
    if (fresh === undefined) return undefined;
    if (known !== undefined && JSON.stringify(known) === JSON.stringify(fresh)) return known;
    this.#known.set(element, fresh);
    return fresh;
  }

  /** The geometry with the values of its attribute of that name; as it is where it has none. */
  withValues(geometry: GeometryDescription, name: string): GeometryDescription {
    const byName = this.#withValues.get(geometry) ?? new Map<string, GeometryDescription>();
    this.#withValues.set(geometry, byName);
    const known = byName.get(name) ?? withValues(geometry, name) ?? geometry;
    byName.set(name, known);
    return known;
  }
}
