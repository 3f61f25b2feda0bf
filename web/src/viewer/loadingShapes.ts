// All shapes of a scene while they load, by their elements.

import type { ShapeDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import type { LoadingShape } from "./loadingShape.ts";

export abstract class LoadingShapes<Shape extends LoadingShape> implements Iterable<Shape> {
  readonly #shapes = new Map<SceneElement, Shape>();

  protected abstract makeShape(described: ShapeDescription): Shape;

  /** While true, shapes join no deliveries: a lost WebGL context cannot store vertices and images. */
  protected abstract get isSuspended(): boolean;

  get(element: SceneElement): Shape | undefined {
    return this.#shapes.get(element);
  }

  [Symbol.iterator](): IterableIterator<Shape> {
    return this.#shapes.values();
  }

  /**
   * Follows the shapes of the scene. Returns a function that ends the deliveries of
   * removed shapes and replaced geometries: call it after the files of new ones have been
   * requested, so that files that both use are not fetched again.
   */
  follow({ shapes, removed }: SceneChanges): () => void {
    const leave: (() => void)[] = [];
    for (const element of removed) {
      const shape = this.#shapes.get(element);
      if (shape === undefined) continue;
      this.#shapes.delete(element);
      shape.onRemoved();
      leave.push(() => {
        shape.cancel();
      });
    }
    for (const described of shapes.values()) leave.push(this.#shapeOf(described).follow(described, this.isSuspended));
    return () => {
      for (const leaveDelivery of leave) leaveDelivery();
    };
  }

  /** All shapes leave their deliveries, until `join`. What these have loaded must no longer be displayed. */
  suspend(): void {
    for (const shape of this) shape.suspend();
  }

  /** All shapes join their deliveries again. */
  join(): void {
    for (const shape of this) shape.join();
  }

  dispose(): void {
    for (const shape of this) shape.onRemoved();
    for (const shape of this) shape.cancel();
    this.#shapes.clear();
  }

  #shapeOf(described: ShapeDescription): Shape {
    const shape = this.#shapes.get(described.element) ?? this.makeShape(described);
    this.#shapes.set(described.element, shape);
    return shape;
  }
}
