// A cache of geometry descriptions between readings of a document. An unchanged geometry, and one that several shapes
// USE, is the same object, so that geometries are compared by identity. So are geometries that reference the same files
// with the same fields: a shape that was copied instead of USEd is neither loaded nor drawn twice.

import type { GeometryDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import type { Warning } from "./nodes.ts";

/** Finds the element with a DEF. */
export type Lookup = (name: string) => SceneElement | undefined;

/** Reads an element; undefined for one that is no geometry. */
export type ReadGeometry = (
  element: SceneElement,
  lookup: Lookup,
  warnings: Warning[],
) => GeometryDescription | undefined;

interface Entry {
  readonly geometry: GeometryDescription;
  readonly warnings: readonly Warning[];
  /** The names that descendants USE. */
  readonly names: readonly string[];
  /** The number of the reading in which the entry was last checked. */
  lastReading: number;
}

export class GeometryCache {
  readonly #known = new WeakMap<SceneElement, Entry>();
  readonly #variants = new WeakMap<GeometryDescription, Map<string, GeometryDescription>>();
  /** By the JSON text of the geometry. */
  readonly #interned = new Map<string, WeakRef<GeometryDescription>>();
  #maxInterned = 1024;
  #touched = new WeakSet<SceneElement>();
  #reading = 0;

  /** Begins another reading of the document. */
  begin(): void {
    this.#reading += 1;
  }

  /** Call where the element or a descendant may have changed. */
  touch(element: SceneElement): void {
    this.#touched.add(element);
  }

  /**
   * The element's geometry, read where the cache lacks it. In both cases `lookup` is called for every name that the
   * geometry USEs.
   */
  geometryOf(
    element: SceneElement,
    lookup: Lookup,
    warnings: Warning[],
    read: ReadGeometry,
  ): GeometryDescription | undefined {
    const known = this.#known.get(element);
    if (known !== undefined && this.#isCurrent(element, known)) {
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
    this.#known.set(element, { geometry, warnings: own, names, lastReading: this.#reading });
    return geometry;
  }

  /** The result of `make`, called once for each key; the geometry itself where the result is undefined. */
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

  /**
   * An equal geometry that is still in use, or this one where there is none. Only for geometries that reference files:
   * their descriptions are small.
   */
  intern(geometry: GeometryDescription): GeometryDescription {
    const key = JSON.stringify(geometry);
    const known = this.#interned.get(key)?.deref();
    if (known !== undefined) return known;
    this.#interned.set(key, new WeakRef(geometry));
    if (this.#interned.size > this.#maxInterned) this.#removeCollected();
    return geometry;
  }

  #removeCollected(): void {
    for (const [key, geometry] of this.#interned) if (geometry.deref() === undefined) this.#interned.delete(key);
    this.#maxInterned = 2 * this.#interned.size;
  }

  /** Elements that it USEs are elsewhere and may have changed: such a geometry is read anew in each reading. */
  #isCurrent(element: SceneElement, { names, lastReading }: Entry): boolean {
    return lastReading === this.#reading || (!this.#touched.has(element) && names.length === 0);
  }
}
