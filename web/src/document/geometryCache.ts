// What has been read of geometry elements, kept from one reading of the document
// to the next: a geometry that did not change, and one that several shapes USE,
// is one and the same object, so that comparing geometries is comparing objects.
// So are geometries that name the same files in the same way: people copy shapes
// where they could USE them, and what is copied is neither loaded nor drawn twice.

import type { GeometryDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import type { Warning } from "./nodes.ts";

/** The element that a DEF names. */
export type Lookup = (name: string) => SceneElement | undefined;

/** Makes a geometry of an element, or nothing of what is none. */
export type ReadGeometry = (
  element: SceneElement,
  lookup: Lookup,
  warnings: Warning[],
) => GeometryDescription | undefined;

interface Remembered {
  readonly geometry: GeometryDescription;
  readonly warnings: readonly Warning[];
  /** What parts of it USE. */
  readonly names: readonly string[];
  /** In which reading it was made, or found to be as before. */
  checkedIn: number;
}

export class GeometryCache {
  readonly #known = new WeakMap<SceneElement, Remembered>();
  readonly #variants = new WeakMap<GeometryDescription, Map<string, GeometryDescription>>();
  /** By all that they say. */
  readonly #alike = new Map<string, WeakRef<GeometryDescription>>();
  #mostAlike = 1024;
  #touched = new WeakSet<SceneElement>();
  #reading = 0;

  /** Another reading of the document begins. */
  begin(): void {
    this.#reading += 1;
  }

  /** Says that the element, or something in it, may have changed. */
  touch(element: SceneElement): void {
    this.#touched.add(element);
  }

  /** What `read` makes of the element, which is called only where that is not known; `lookup` is asked for all that it USEs either way. */
  recall(
    element: SceneElement,
    lookup: Lookup,
    warnings: Warning[],
    read: ReadGeometry,
  ): GeometryDescription | undefined {
    const known = this.#known.get(element);
    if (known !== undefined && this.#isSure(element, known)) {
      known.names.forEach(lookup);
      warnings.push(...known.warnings);
      return known.geometry;
    }
    const names: string[] = [];
    const own: Warning[] = [];
    const fresh = read(
      element,
      (name) => {
        names.push(name);
        return lookup(name);
      },
      own,
    );
    warnings.push(...own);
    this.#touched.delete(element);
    if (fresh === undefined) {
      this.#known.delete(element);
      return undefined;
    }
    const geometry =
      known !== undefined && JSON.stringify(known.geometry) === JSON.stringify(fresh) ? known.geometry : fresh;
    this.#known.set(element, { geometry, warnings: own, names, checkedIn: this.#reading });
    return geometry;
  }

  /** What `make` makes of the geometry, which is called once for each key; the geometry itself where that is nothing. */
  variant(
    geometry: GeometryDescription,
    key: string,
    make: (geometry: GeometryDescription) => GeometryDescription | undefined,
  ): GeometryDescription {
    const variants = this.#variants.get(geometry) ?? new Map<string, GeometryDescription>();
    this.#variants.set(geometry, variants);
    const known = variants.get(key) ?? make(geometry) ?? geometry;
    variants.set(key, known);
    return known;
  }

  /** The geometry that says the same as this one and is still somewhere; this one where there is none. For geometries of files: what it says is its key. */
  intern(geometry: GeometryDescription): GeometryDescription {
    const key = JSON.stringify(geometry);
    const known = this.#alike.get(key)?.deref();
    if (known !== undefined) return known;
    this.#alike.set(key, new WeakRef(geometry));
    if (this.#alike.size > this.#mostAlike) this.#forgetGone();
    return geometry;
  }

  #forgetGone(): void {
    for (const [key, geometry] of this.#alike) if (geometry.deref() === undefined) this.#alike.delete(key);
    this.#mostAlike = 2 * this.#alike.size;
  }

  /** What it USEs stands elsewhere, and may have changed there: once a reading it is read anew. */
  #isSure(element: SceneElement, { names, checkedIn }: Remembered): boolean {
    return checkedIn === this.#reading || (!this.#touched.has(element) && names.length === 0);
  }
}
