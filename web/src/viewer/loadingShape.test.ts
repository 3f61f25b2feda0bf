import assert from "node:assert/strict";
import { afterEach, beforeEach, describe, mock, test } from "node:test";
import type { DeliveryListener } from "../delivery/geometryDelivery.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { GeometryDescription, ShapeDescription } from "../document/description.ts";
import type { Stage } from "../stage/stage.ts";
import type { DisplayedFrame, StageChange } from "./loadingShape.ts";
import { LoadingShape } from "./loadingShape.ts";

const pauseMs = 100;

/** A geometry whose delivery the test completes by hand. */
interface Download {
  readonly geometry: GeometryDescription;
  readonly listener: DeliveryListener;
  /** Undefined: not requested. */
  isSettled: boolean | undefined;
  isCancelled: boolean;
  /** The name of the geometry that follows it. */
  successor: string | undefined;
}

class FakeDeliveries {
  readonly downloads: Download[] = [];

  readonly scene = {
    geometries: {
      join: (geometry: GeometryDescription, listener: DeliveryListener) => {
        const download: Download = {
          geometry,
          listener,
          isSettled: undefined,
          isCancelled: false,
          successor: undefined,
        };
        this.downloads.push(download);
        return {
          transfers: [],
          get isSettled() {
            return download.isSettled ?? true;
          },
          isExhausted: false,
          setPlayback: () => undefined,
          request: () => {
            download.isSettled = false;
          },
          leadTo: (next: GeometryDescription) => {
            download.successor = nameOf(next);
          },
          cancel: () => {
            download.isCancelled = true;
          },
        };
      },
    },
    textures: {},
  } as unknown as SceneDeliveries;

  /** What the viewer does when it has read the document. */
  request(): void {
    for (const download of this.downloads) download.isSettled ??= false;
  }

  of(name: string): Download {
    return this.downloads.findLast(({ geometry }) => nameOf(geometry) === name) ?? assert.fail(`${name} is not joined`);
  }

  get names(): string[] {
    return this.downloads.map(({ geometry }) => nameOf(geometry));
  }

  /** All files of a geometry arrive, or fail. */
  complete(name: string, hasFailed = false): void {
    const download = this.of(name);
    assert.ok(!download.isCancelled, `${name} was cancelled`);
    if (!hasFailed) download.listener.onStage(0, {} as Stage);
    download.isSettled = true;
    download.listener.onSettled();
  }

  frame(name: string, number: number, epoch = 0): void {
    this.of(name).listener.onFrame?.({ number, epoch, time: 0 });
  }
}

const nameOf = ({ patches: [patch] }: GeometryDescription): string => patch?.coord[0]?.url ?? "";

class TestShape extends LoadingShape {
  /** What is displayed: the geometries in turn, and the frames of streams. */
  readonly displayed: string[] = [];
  readonly frames: number[] = [];
  readonly replacing: boolean[] = [];

  protected override onStage({ geometry, stage }: StageChange): void {
    if (stage !== undefined && this.displayed.at(-1) !== nameOf(geometry)) this.displayed.push(nameOf(geometry));
  }
  protected override onFrame({ number }: DisplayedFrame): void {
    this.frames.push(number);
  }
  protected override onReplacing(isReplacing: boolean): void {
    this.replacing.push(isReplacing);
  }
  protected override onSwap(): void {
    // nothing is on a GPU
  }
  protected override onGeometryReplaced(): void {
    // the test reads what is displayed
  }
  protected override onTextureImage(): void {
    assert.fail("no textures");
  }
  protected override onError(): void {
    // of files that fail
  }
  protected override onSettled(): void {
    // the test completes files
  }
  override onRemoved(): void {
    // it stays
  }
}

function describedAs(name: string): ShapeDescription {
  return {
    element: {},
    appearance: { textures: [] },
    visible: true,
    geometry: { patches: [{ coord: [{ url: name.replace(/\?.*/, "") }] }], name },
  } as unknown as ShapeDescription;
}

function shapeOf(name: string): { shape: TestShape; deliveries: FakeDeliveries; describe: (name: string) => void } {
  const deliveries = new FakeDeliveries();
  const shape = new TestShape(deliveries.scene, describedAs(name));
  shape.join();
  deliveries.request();
  return {
    shape,
    deliveries,
    describe: (next) => {
      const leave = shape.follow(describedAs(next), false);
      deliveries.request();
      leave();
    },
  };
}

describe("a shape whose geometry changes", () => {
  beforeEach(() => {
    mock.timers.enable({ apis: ["setTimeout"] });
  });
  afterEach(() => {
    mock.timers.reset();
  });

  test("displays the one before until the described one is whole", () => {
    const { shape, deliveries, describe } = shapeOf("a");
    deliveries.complete("a");
    describe("b");
    deliveries.of("b").listener.onStage(0, {} as Stage);
    assert.deepEqual([shape.replacing, deliveries.of("a").isCancelled], [[true], false]);
    assert.deepEqual(shape.displayed, ["a"]);
    deliveries.complete("b");
    assert.deepEqual(shape.displayed, ["a", "b"]);
    assert.deepEqual([shape.replacing, deliveries.of("a").isCancelled], [[true, false], true]);
  });

  test("displays the newest whole one while a script changes it faster than files load", () => {
    const { shape, deliveries, describe } = shapeOf("0");
    deliveries.complete("0");
    for (let n = 1; n <= 12; ++n) {
      describe(`${n}`);
      mock.timers.tick(16);
      if (n % 4 === 0) deliveries.complete(deliveries.names.at(-1) ?? "");
    }
    // A fourth of the geometries is requested, none of them in vain.
    assert.deepEqual(deliveries.names, ["0", "1", "4", "8", "12"]);
    assert.deepEqual(shape.displayed, ["0", "1", "4", "8"]);
    deliveries.complete("12");
    assert.deepEqual(shape.displayed, ["0", "1", "4", "8", "12"]);
    assert.deepEqual(
      deliveries.downloads.map(({ isCancelled }) => isCancelled),
      [true, true, true, true, false],
    );
  });

  test("requests the described one beside an earlier one as soon as the script pauses", () => {
    const { shape, deliveries, describe } = shapeOf("0");
    deliveries.complete("0");
    for (const name of ["1", "2", "3"]) describe(name);
    assert.deepEqual(deliveries.names, ["0", "1"]);
    assert.equal(deliveries.of("1").successor, "3");
    mock.timers.tick(pauseMs);
    assert.deepEqual(deliveries.names, ["0", "1", "3"]);
    deliveries.complete("3");
    assert.deepEqual(shape.displayed, ["0", "3"]);
    assert.ok(deliveries.of("1").isCancelled);
  });

  test("goes on after an earlier one that cannot be used, and after the described one", () => {
    const { shape, deliveries, describe } = shapeOf("0");
    deliveries.complete("0");
    describe("1");
    describe("2");
    deliveries.complete("1", true);
    assert.deepEqual(deliveries.names, ["0", "1", "2"]);
    deliveries.complete("2", true);
    assert.deepEqual(shape.displayed, ["0"]);
    describe("3");
    deliveries.complete("3");
    assert.deepEqual(shape.displayed, ["0", "3"]);
  });

  test("displays something even if it changes all the time from the start", () => {
    const { shape, deliveries, describe } = shapeOf("0");
    for (let n = 1; n < 5; ++n) describe(`${n}`);
    deliveries.complete("0");
    assert.deepEqual(shape.displayed, ["0"]);
    deliveries.complete("4");
    assert.deepEqual(shape.displayed, ["0", "4"]);
  });

  test("displays stages of the described one as they arrive where nothing is displayed", () => {
    const { shape, deliveries, describe } = shapeOf("0");
    describe("1");
    deliveries.of("1").listener.onStage(0, {} as Stage);
    assert.deepEqual(shape.displayed, ["1"]);
    assert.ok(deliveries.of("0").isCancelled);
  });

  test("never goes back to an earlier frame of a stream", () => {
    const { shape, deliveries, describe } = shapeOf("live/a?1");
    const first = deliveries.of("live/a");
    deliveries.frame("live/a", 7);
    deliveries.complete("live/a");
    describe("live/a?2");
    deliveries.frame("live/a", 5); // of the new delivery
    const other = deliveries.of("live/a");
    other.isSettled = true;
    other.listener.onStage(0, {} as Stage);
    other.listener.onSettled();
    first.listener.onFrame?.({ number: 8, epoch: 0, time: 0 });
    assert.ok(!first.isCancelled);
    deliveries.frame("live/a", 8);
    assert.ok(first.isCancelled);
    deliveries.frame("live/a", 9);
    assert.deepEqual(shape.frames, [7, 8, 9]);
  });

  test("leaves all deliveries when it is removed", () => {
    const { shape, deliveries, describe } = shapeOf("0");
    deliveries.complete("0");
    describe("1");
    describe("2");
    shape.cancel();
    mock.timers.tick(pauseMs);
    assert.deepEqual(deliveries.names, ["0", "1"]);
    assert.ok(deliveries.downloads.every(({ isCancelled }) => isCancelled));
  });
});
