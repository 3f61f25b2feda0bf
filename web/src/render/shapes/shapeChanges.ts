// Collects the changes of shapes while a scene gets a new description.

import type { ShapeDescription } from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import type { NodeInstance } from "../../scene/nodeInstance.ts";
import type { ShapeInstance } from "../../scene/instances.ts";

export interface SceneChanges {
  /** New and changed shapes by their elements; `visible` if one of their instances is visible. */
  readonly shapes: ReadonlyMap<SceneElement, ShapeDescription>;
  /** Elements whose shapes have no instances any more. */
  readonly removed: readonly SceneElement[];
  /** New, moved and changed instances; undefined for an instance that has been removed. */
  readonly instances: ReadonlyMap<NodeInstance, ShapeInstance | undefined>;
}

/** The instance of a shape as it is now; undefined for other nodes. */
export function shapeInstanceOf({ description, sceneFromNode, effectScope }: NodeInstance): ShapeInstance | undefined {
  return description.kind === "shape" ? { shape: description, sceneFromShape: sceneFromNode, effectScope } : undefined;
}

/** Records the changes from which SceneChanges are made. */
export class ShapeChangeRecorder {
  /** The last descriptions of changed shapes, including shapes that have been removed. */
  readonly shapes = new Map<SceneElement, ShapeDescription>();
  readonly instances = new Map<NodeInstance, ShapeInstance | undefined>();

  recordPresent(shape: ShapeDescription, instance: NodeInstance): void {
    this.shapes.set(shape.element, shape);
    this.instances.set(instance, shapeInstanceOf(instance));
  }

  /** Records that one instance of a shape has been removed; others may remain. */
  recordRemoved(shape: ShapeDescription, instance: NodeInstance): void {
    if (!this.shapes.has(shape.element)) this.shapes.set(shape.element, shape);
    this.instances.set(instance, undefined);
  }
}
