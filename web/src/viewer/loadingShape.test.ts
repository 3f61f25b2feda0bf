import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { GeometryDescription, ImageDescription, ShapeDescription } from "../document/description.ts";
import { LoadingShape } from "./loadingShape.ts";

class TestShape extends LoadingShape {
  readonly errors: string[] = [];
  /** The roles of textures that have no image any more. */
  readonly cleared: string[] = [];

  override onError({ message }: DeliveryError): void {
    this.errors.push(message);
  }
  override onTextureImage(role: string): void {
    this.cleared.push(role);
  }
  override onStage(): void {
    assert.fail("no file arrives");
  }
  override onFrame(): void {
    assert.fail("no stream");
  }
  override onGeometryReplaced(): void {
    // nothing is displayed
  }
  override onReplacing(): void {
    // nothing is displayed
  }
  override onSwap(): void {
    // nothing is displayed
  }
  override onSettled(): void {
    // no file arrives
  }
  override onRemoved(): void {
    // it stays
  }
}

const geometry = (changes: object = {}) => ({ patches: [], ...changes }) as unknown as GeometryDescription;

function described(changes: Partial<ShapeDescription> = {}): ShapeDescription {
  const textures = ["color", "normal"].map((role) => ({ role, urls: [`${role}.png`] }));
  return { element: {}, appearance: { textures }, visible: true, ...changes } as unknown as ShapeDescription;
}

/** A shape, and the deliveries that it has joined and not left. */
function shapeOf(description: ShapeDescription) {
  const joined = new Set<string>();
  const join = (name: string) => {
    joined.add(name);
    return { transfers: [], isSettled: true, setPlayback: () => undefined, cancel: () => joined.delete(name) };
  };
  const deliveries = {
    geometries: { join: () => join("geometry") },
    textures: { join: ({ urls }: ImageDescription) => join(urls[0] ?? "") },
  } as unknown as SceneDeliveries;
  return { shape: new TestShape(deliveries, description), joined };
}

describe("a loading shape", () => {
  test("joins the deliveries of its geometry and its textures, and leaves those that are no longer described", () => {
    const { shape, joined } = shapeOf(described({ geometry: geometry() }));
    assert.equal(joined.size, 0);
    const leave = shape.follow(described({ geometry: geometry() }), false);
    assert.deepEqual([...joined], ["geometry", "color.png", "normal.png"]);
    leave();
    shape.follow(described(), false)();
    assert.deepEqual([...joined], ["color.png", "normal.png"]);
    shape.cancel();
    assert.equal(joined.size, 0);
  });

  test("joins nothing while it is suspended, and all of it again afterwards", () => {
    const description = described({ geometry: geometry() });
    const { shape, joined } = shapeOf(description);
    shape.follow(description, false)();
    shape.suspend();
    assert.deepEqual([[...joined], shape.cleared], [[], ["color", "normal"]]);
    shape.follow(description, true)();
    assert.equal(joined.size, 0);
    shape.join();
    assert.deepEqual([...joined], ["geometry", "color.png", "normal.png"]);
  });

  test("reports once why a geometry is not drawn", () => {
    const { shape } = shapeOf(described({ unreadableGeometry: "is a NURBS" }));
    shape.join();
    shape.join();
    assert.deepEqual([shape.errors.length, shape.errors[0]?.includes("is a NURBS")], [1, true]);
    shape.follow(described({ geometry: geometry() }), false)();
    shape.follow(described({ unreadableGeometry: "is a NURBS" }), false)();
    assert.equal(shape.errors.length, 2);
  });

  test("has no color texture where the groups of its geometry have images instead of it", () => {
    const { shape, joined } = shapeOf(described());
    shape.follow(described({ geometry: geometry({ levels: { chips: {} } }) }), false)();
    assert.deepEqual([...joined], ["geometry", "normal.png"]);
  });
});
