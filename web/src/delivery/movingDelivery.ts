// The delivery of geometry whose vertices animation moves (MovingGeometry): arrays on the GPU that are written again
// whenever they have changed. Nothing is requested.

import type { GeometryDescription } from "../document/description.ts";
import type { MovingAttribute, MovingGeometry } from "../document/movingGeometry.ts";
import type { BudgetRequest } from "../scheduler/budget.ts";
import { elementTypeOf } from "../stage/elementType.ts";
import type { BufferStage, GpuVertices, WritableArray } from "../stage/stage.ts";
import type { ElementArray } from "../stage/vertexArray.ts";
import type { Delivery, DeliveryListener } from "./geometryDelivery.ts";
import type { ResourcePool } from "./resourcePool.ts";

/** The number of components of each vertex; of colors, the geometry states it. */
const componentsOf = { positions: 3, normals: 3, texCoords: 2 } as const;

/** An array that changes, and the attribute of a stage that reads it. */
interface StoredArray {
  readonly writable: WritableArray;
  readonly vertices: GpuVertices;
}

/** Never calls the listener before it returns. */
export function deliverMoving(
  geometry: GeometryDescription,
  moving: MovingGeometry,
  pool: Pick<ResourcePool, "makeWritableArray">,
  listener: DeliveryListener,
): Delivery {
  return new MovingDelivery(geometry, moving, pool, listener);
}

class MovingDelivery implements Delivery {
  readonly transfers: Delivery["transfers"] = [];
  readonly #geometry: GeometryDescription;
  readonly #moving: MovingGeometry;
  readonly #pool: Pick<ResourcePool, "makeWritableArray">;
  readonly #listener: DeliveryListener;
  readonly #stored = new Map<MovingAttribute, StoredArray>();
  /** Further sets of texture coordinates, and depths in fog, which do not move. */
  readonly #fixed: StoredArray[] = [];
  #stage: BufferStage | undefined;
  #stopListening = (): void => undefined;
  #isRequested = false;

  constructor(
    geometry: GeometryDescription,
    moving: MovingGeometry,
    pool: Pick<ResourcePool, "makeWritableArray">,
    listener: DeliveryListener,
  ) {
    this.#geometry = geometry;
    this.#moving = moving;
    this.#pool = pool;
    this.#listener = listener;
  }

  get isSettled(): boolean {
    return this.#stage !== undefined || !this.#isRequested;
  }

  get isExhausted(): boolean {
    return this.#isRequested;
  }

  get followsView(): boolean {
    return !this.#isRequested;
  }

  get storedBytes(): number {
    return [...this.#stored.values(), ...this.#fixed].reduce((sum, { vertices }) => sum + vertices.bytes.byteLength, 0);
  }

  /** It is small, since its numbers have been in the document, and never evicted. */
  budgetRequests(): readonly (readonly BudgetRequest[])[] {
    return [];
  }

  request(): void {
    if (this.#isRequested) return;
    this.#isRequested = true;
    queueMicrotask(() => {
      if (!this.#isRequested) return;
      this.#begin();
      this.#listener.onSettled();
    });
  }

  cancel(): void {
    this.#isRequested = false;
    this.#stopListening();
    for (const { writable } of [...this.#stored.values(), ...this.#fixed]) writable.bytes.close();
    this.#stored.clear();
  }

  #begin(): void {
    const { arrays } = this.#moving;
    for (const attribute of ["positions", "normals", "texCoords", "colors"] as const) {
      const array = arrays[attribute];
      const components = attribute === "colors" ? this.#geometry.colorComponents : componentsOf[attribute];
      if (array) this.#stored.set(attribute, this.#store(array, components));
    }
    for (const texCoords of arrays.furtherTexCoords ?? []) this.#fixed.push(this.#store(texCoords, 2));
    if (arrays.fogDepths) this.#fixed.push(this.#store(arrays.fogDepths, 1));
    this.#stopListening = this.#moving.listen((changed) => {
      for (const attribute of changed) {
        const array = arrays[attribute];
        if (array) this.#stored.get(attribute)?.writable.write(array);
      }
      if (this.#stage?.bounds !== this.#moving.bounds) this.#report();
    });
    this.#report();
  }

  #store(array: ElementArray, components: GpuVertices["components"]): StoredArray {
    const writable = this.#pool.makeWritableArray(array);
    return {
      writable,
      vertices: { bytes: writable.bytes, type: elementTypeOf(array), components, stride: components, offset: 0 },
    };
  }

  /** A stage with the present bounds, and always the same arrays. */
  #report(): void {
    const [patch] = this.#geometry.patches;
    const coord = this.#stored.get("positions")?.vertices;
    if (patch === undefined || coord === undefined) return;
    const { fogDepths, primitive } = this.#moving.arrays;
    const fixed = this.#fixed.map(({ vertices }) => vertices);
    const depths = fogDepths ? fixed.pop() : undefined;
    const [texCoord1, texCoord2, texCoord3] = fixed;
    this.#stage = {
      kind: "buffers",
      name: "full",
      vertexCount: patch.vertexCount,
      index: undefined,
      draws: [{ primitive, first: 0, count: patch.vertexCount }],
      coord,
      bounds: this.#moving.bounds,
      attributes: {
        normal: this.#stored.get("normals")?.vertices,
        texCoord: this.#stored.get("texCoords")?.vertices,
        texCoord1,
        texCoord2,
        texCoord3,
        color: this.#stored.get("colors")?.vertices,
      },
      normalFormat: { kind: "vector" },
      value: depths && this.#geometry.value && { ...depths, maxStored: undefined },
    };
    this.#listener.onStage(0, this.#stage);
  }
}
