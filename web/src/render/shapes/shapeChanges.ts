// What becomes of the shapes of a scene while it is described anew.

import type { ShapeDescription } from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import type { NodeInstance } from "../../scene/nodeInstance.ts";
import type { ShapeInstance } from "../../scene/instances.ts";

export interface SceneChanges {
  /** Shapes that are new, or of which something else is said, by their elements: visible where one of their places is. */
  readonly shapes: ReadonlyMap<SceneElement, ShapeDescription>;
  /** Elements that are shapes no longer. */
  readonly removed: readonly SceneElement[];
  /** Places that are new, have moved, or whose shapes say something else; undefined where one is gone. */
  readonly instances: ReadonlyMap<NodeInstance, ShapeInstance | undefined>;
}

export class ShapeChanges {
  /** As they were described last, also those that may be gone. */
  readonly shapes = new Map<SceneElement, ShapeDescription>();
  readonly instances = new Map<NodeInstance, ShapeInstance | undefined>();

  recordPresent(shape: ShapeDescription, place: NodeInstance): void {
    this.shapes.set(shape.element, shape);
    this.instances.set(place, { shape, sceneFromShape: place.sceneFromNode, lightScope: place.lightScope });
  }

  /** In its other places it says the same, or will be noted as what it is there. */
  recordRemoved(shape: ShapeDescription, place: NodeInstance): void {
    if (!this.shapes.has(shape.element)) this.shapes.set(shape.element, shape);
    this.instances.set(place, undefined);
  }
}
