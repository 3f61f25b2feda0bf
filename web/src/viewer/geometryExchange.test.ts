import assert from "node:assert/strict";
import { afterEach, beforeEach, describe, mock, test } from "node:test";
import type { DeliveryListener } from "../delivery/geometryDelivery.ts";
import type { GeometryDeliveries } from "../delivery/geometryDeliveries.ts";
import type { GeometryDescription } from "../document/description.ts";
import type { Stage } from "../stage/stage.ts";
import type { DisplayedFrame } from "./displayedFrames.ts";
import type { GeometryExchangeListener, StageChange } from "./geometryExchange.ts";
import { GeometryExchange } from "./geometryExchange.ts";

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

  readonly geometries = {
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
  } as unknown as GeometryDeliveries;

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

class Display implements GeometryExchangeListener {
  /** What is displayed: the geometries in turn, and the frames of streams. */
  readonly displayed: string[] = [];
  readonly frames: number[] = [];
  readonly replacing: boolean[] = [];

  onStage({ geometry, stage }: StageChange): void {
    if (stage !== undefined && this.displayed.at(-1) !== nameOf(geometry)) this.displayed.push(nameOf(geometry));
  }
  onFrame({ number }: DisplayedFrame): void {
    this.frames.push(number);
  }
  onReplacing(isReplacing: boolean): void {
    this.replacing.push(isReplacing);
  }
  onSwap(): void {
    // nothing is on a GPU
  }
  onGeometryReplaced(): void {
    // the test reads what is displayed
  }
  onError(): void {
    // of files that fail
  }
  onSettled(): void {
    // the test completes files
  }
}

function described(name: string): GeometryDescription {
  const patches = [{ coord: [{ url: name.replace(/\?.*/, "") }] }];
  return { patches, name } as unknown as GeometryDescription;
}

function exchangeOf(name: string) {
  const deliveries = new FakeDeliveries();
  const display = new Display();
  const exchange = new GeometryExchange(deliveries.geometries, described(name), display);
  exchange.join();
  deliveries.request();
  return {
    exchange,
    display,
    deliveries,
    replaceBy: (next: string) => {
      const left = exchange.replace(described(next));
      exchange.join();
      deliveries.request();
      left?.cancel();
    },
  };
}

describe("a geometry that changes while it loads", () => {
  beforeEach(() => {
    mock.timers.enable({ apis: ["setTimeout"] });
  });
  afterEach(() => {
    mock.timers.reset();
  });

  test("displays the one before until the described one is whole", () => {
    const { display, deliveries, replaceBy } = exchangeOf("a");
    deliveries.complete("a");
    replaceBy("b");
    deliveries.of("b").listener.onStage(0, {} as Stage);
    assert.deepEqual([display.replacing, deliveries.of("a").isCancelled], [[true], false]);
    assert.deepEqual(display.displayed, ["a"]);
    deliveries.complete("b");
    assert.deepEqual(display.displayed, ["a", "b"]);
    assert.deepEqual([display.replacing, deliveries.of("a").isCancelled], [[true, false], true]);
  });

  test("displays the newest whole one while a script changes it faster than files load", () => {
    const { display, deliveries, replaceBy } = exchangeOf("0");
    deliveries.complete("0");
    for (let n = 1; n <= 12; ++n) {
      replaceBy(`${n}`);
      mock.timers.tick(16);
      if (n % 4 === 0) deliveries.complete(deliveries.names.at(-1) ?? "");
    }
    // A fourth of the geometries is requested, none of them in vain.
    assert.deepEqual(deliveries.names, ["0", "1", "4", "8", "12"]);
    assert.deepEqual(display.displayed, ["0", "1", "4", "8"]);
    deliveries.complete("12");
    assert.deepEqual(display.displayed, ["0", "1", "4", "8", "12"]);
    assert.deepEqual(
      deliveries.downloads.map(({ isCancelled }) => isCancelled),
      [true, true, true, true, false],
    );
  });

  test("requests the described one beside an earlier one as soon as the script pauses", () => {
    const { display, deliveries, replaceBy } = exchangeOf("0");
    deliveries.complete("0");
    for (const name of ["1", "2", "3"]) replaceBy(name);
    assert.deepEqual(deliveries.names, ["0", "1"]);
    assert.equal(deliveries.of("1").successor, "3");
    mock.timers.tick(pauseMs);
    assert.deepEqual(deliveries.names, ["0", "1", "3"]);
    deliveries.complete("3");
    assert.deepEqual(display.displayed, ["0", "3"]);
    assert.ok(deliveries.of("1").isCancelled);
  });

  test("goes on after an earlier one that cannot be used, and after the described one", () => {
    const { display, deliveries, replaceBy } = exchangeOf("0");
    deliveries.complete("0");
    replaceBy("1");
    replaceBy("2");
    deliveries.complete("1", true);
    assert.deepEqual(deliveries.names, ["0", "1", "2"]);
    deliveries.complete("2", true);
    assert.deepEqual(display.displayed, ["0"]);
    replaceBy("3");
    deliveries.complete("3");
    assert.deepEqual(display.displayed, ["0", "3"]);
  });

  test("displays something even if it changes all the time from the start", () => {
    const { display, deliveries, replaceBy } = exchangeOf("0");
    for (let n = 1; n < 5; ++n) replaceBy(`${n}`);
    deliveries.complete("0");
    assert.deepEqual(display.displayed, ["0"]);
    deliveries.complete("4");
    assert.deepEqual(display.displayed, ["0", "4"]);
  });

  test("displays stages of the described one as they arrive where nothing is displayed", () => {
    const { display, deliveries, replaceBy } = exchangeOf("0");
    replaceBy("1");
    deliveries.of("1").listener.onStage(0, {} as Stage);
    assert.deepEqual(display.displayed, ["1"]);
    assert.ok(deliveries.of("0").isCancelled);
  });

  test("never goes back to an earlier frame of a stream", () => {
    const { display, deliveries, replaceBy } = exchangeOf("live/a?1");
    const first = deliveries.of("live/a");
    deliveries.frame("live/a", 7);
    deliveries.complete("live/a");
    replaceBy("live/a?2");
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
    assert.deepEqual(display.frames, [7, 8, 9]);
  });

  test("leaves all deliveries when it is removed", () => {
    const { exchange, deliveries, replaceBy } = exchangeOf("0");
    deliveries.complete("0");
    replaceBy("1");
    replaceBy("2");
    exchange.cancel();
    mock.timers.tick(pauseMs);
    assert.deepEqual(deliveries.names, ["0", "1"]);
    assert.ok(deliveries.downloads.every(({ isCancelled }) => isCancelled));
  });
});
