// Numbers of geometry nodes that animation has given them, in place of those in the document, which are text: text of
// thousands of numbers would be written and read again in every frame.

import type { SceneElement } from "./element.ts";
import type { MovingGeometry } from "./movingGeometry.ts";

export class MovingValues {
  readonly #numbers = new WeakMap<SceneElement, Map<string, readonly number[]>>();
  readonly #byElement = new WeakMap<SceneElement, MovingGeometry>();
  /** By the nodes whose fields they depend on, and by their own elements. */
  readonly #geometries = new WeakMap<SceneElement, Map<SceneElement, WeakRef<MovingGeometry>>>();

  /** The numbers that a field has got last; undefined where the document's count. */
  numbersOf(element: SceneElement | undefined, field: string): readonly number[] | undefined {
    return element && this.#numbers.get(element)?.get(field);
  }

  /** The fields of an element that have got numbers. */
  fieldsOf(element: SceneElement): Readonly<Record<string, readonly number[]>> {
    return Object.fromEntries(this.#numbers.get(element) ?? []);
  }

  has(element: SceneElement): boolean {
    return this.#numbers.has(element);
  }

  /** Gives a field numbers. Returns whether all geometry that has been read with them displays them: see `join`. */
  set(element: SceneElement, field: string, numbers: readonly number[]): boolean {
    const fields = this.#numbers.get(element) ?? new Map<string, readonly number[]>();
    this.#numbers.set(element, fields.set(field, numbers));
    let areMoved = this.#geometries.has(element);
    for (const reference of this.#geometries.get(element)?.values() ?? [])
      areMoved = reference.deref()?.move(element, numbers) !== false && areMoved;
    return areMoved;
  }

  /** From now on the document's numbers count again. */
  forget(element: SceneElement): void {
    this.#numbers.delete(element);
  }

  /** The geometry that has been made for an element before. */
  geometryOf(element: SceneElement): MovingGeometry | undefined {
    return this.#byElement.get(element);
  }

  /** The geometry of `element` moves with the numbers of these nodes. */
  join(nodes: Iterable<SceneElement>, element: SceneElement, geometry: MovingGeometry): void {
    this.#byElement.set(element, geometry);
    for (const node of nodes) {
      const geometries = this.#geometries.get(node) ?? new Map<SceneElement, WeakRef<MovingGeometry>>();
      this.#geometries.set(node, geometries.set(element, new WeakRef(geometry)));
    }
  }
}
