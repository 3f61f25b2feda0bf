// A live stream as docs/live.md describes it, whose frames a test publishes one by one.

import { encodeFrame } from "../../web/src/decode/frame/encodeFrame.testing.ts";
import type { FrameLayout } from "../../web/src/decode/frame/frameHeader.ts";
import { decodePng } from "./png.ts";
import type { GridExample } from "./generators/grids.ts";
import type { Answer, TestServer } from "./server.ts";

const historyLength = 30;
const waitMs = 60_000;

export class TestStream {
  /** Answers every request with this status, as a server that is being restarted does. */
  failingStatus: number | undefined;
  #state: Record<string, unknown> = {};
  #epoch = 0;
  #next = 1000;
  readonly #frames = new Map<number, Uint8Array>();
  #waiting: (() => void)[] = [];

  constructor(server: TestServer, name: string) {
    server.when(new RegExp(`^/live/${name}/`), { answer: (path) => this.#answer(path) });
  }

  get number(): number {
    return this.#next - 1;
  }

  /** Begins another epoch with the lattice and the vertices of a surface of 16 bits. */
  begin(
    { columns, rows, position, size }: GridExample,
    further: Partial<FrameLayout> & { valueRange?: number[][] } = {},
  ): void {
    this.#epoch = this.#next;
    this.#frames.clear();
    const origin = position.map((center, axis) => center - size[axis]! / 2);
    this.#state = {
      name: "test",
      epoch: this.#epoch,
      rate: 30,
      ended: false,
      vertices: columns * rows,
      columns,
      positionBits: 16,
      origin,
      step: size[0] / 65535,
      box: [origin, origin.map((low, axis) => low + size[axis]!)],
      normalBits: 0,
      colorComponents: 0,
      valueComponents: 0,
      valueBits: 0,
      valueRange: [],
      ...further,
    };
  }

  /** Publishes the points of a surface, and further components; `damage` changes the bytes. */
  publish(
    example: GridExample,
    further: readonly ArrayLike<number>[] = [],
    damage: (bytes: Uint8Array) => Uint8Array = (bytes) => bytes,
  ): void {
    const number = this.#next++;
    const header = {
      ...(this.#state as unknown as FrameLayout),
      number,
      epoch: this.#epoch,
      time: number / 30,
      prediction: "planar",
    } as const;
    this.#frames.set(number, damage(encodeFrame(header, [...storedPoints(example), ...further])));
    this.#frames.delete(number - historyLength);
    for (const wake of this.#waiting.splice(0)) wake();
  }

  async #answer(path: string): Promise<Answer> {
    if (this.failingStatus !== undefined) return { status: this.failingStatus };
    if (path.endsWith("/latest")) {
      const number = this.#frames.size > 0 ? this.number : null;
      return { status: 200, body: JSON.stringify({ ...this.#state, number, next: this.#next }) };
    }
    const number = Number(/\d+$/.exec(path)?.[0]);
    if (number > this.number + 8) return { status: 404, headers: this.#headers };
    for (const end = Date.now() + waitMs; number > this.number && Date.now() < end;)
      await new Promise<void>((resolve) => {
        this.#waiting.push(resolve);
        // When a test ends, its page still waits for a frame; that must not keep the process of the tests alive.
        setTimeout(resolve, waitMs).unref();
      });
    const body = this.#frames.get(number);
    if (body === undefined && number > this.number) return { status: 503, headers: this.#headers };
    if (body === undefined) return { status: 307, headers: { ...this.#headers, Location: `${this.number}` } };
    return { status: 200, headers: this.#headers, body: Buffer.from(body) };
  }

  get #headers(): Record<string, string> {
    return { "Imgeo-Newest": `${this.number}`, "Imgeo-Epoch": `${this.#epoch}` };
  }
}

/** The stored integers of x, y and z. */
function storedPoints({ columns, rows, files }: GridExample): Uint32Array[] {
  const planes = [...files.values()].map((file) => decodePng(file));
  return [0, 1, 2].map((axis) =>
    Uint32Array.from({ length: columns * rows }, (_, n) =>
      planes.reduce((value, { data, channels }) => 256 * value + data[n * channels + axis]!, 0),
    ),
  );
}
