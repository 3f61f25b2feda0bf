// A slow network link between a server and its clients: all connections share its bandwidth, and every answer starts a
// round trip late.

import type { IncomingMessage, ServerResponse } from "node:http";
import type { Socket } from "node:net";

export interface LinkOptions {
  bitsPerSecond: number;
  roundTripMs: number;
}

/** What a link has carried since its `usage` was read last. */
export interface LinkUsage {
  bytes: number;
  /** Milliseconds that the bytes take at the link's bandwidth. */
  busyMs: number;
  /** Milliseconds between the first byte and the last in which the link carried nothing. */
  idleMs: number;
}

/** Small enough that connections take turns on a slow line, large enough for node's timers on a fast one. */
const packetBytes = 4096;
/** Status line and headers, roughly. */
const headBytes = 300;

export class NetworkLink {
  readonly #options: LinkOptions;
  readonly #connected = new WeakSet<Socket>();
  /** Time at which the link will have sent everything that it has been given. */
  #freeAt = 0;
  #firstAt = 0;
  #bytes = 0;

  constructor(options: LinkOptions) {
    this.#options = options;
  }

  /** What the link has carried since the last call. */
  takeUsage(): LinkUsage {
    const busyMs = this.#msOf(this.#bytes);
    const usage = { bytes: this.#bytes, busyMs, idleMs: Math.max(0, this.#freeAt - this.#firstAt - busyMs) };
    this.#bytes = 0;
    return usage;
  }

  #msOf(bytes: number): number {
    return (8000 * bytes) / this.#options.bitsPerSecond;
  }

  /** Waits until the server's first byte can arrive; a new connection takes an additional round trip. */
  async arrive({ socket }: IncomingMessage): Promise<void> {
    const isNew = !this.#connected.has(socket);
    this.#connected.add(socket);
    await pause((isNew ? 2 : 1) * this.#options.roundTripMs);
    await this.#transmit(headBytes);
  }

  /** Sends the body at the link's bandwidth; stops when the client disconnects. */
  async send(response: ServerResponse, body: Uint8Array): Promise<void> {
    for (let at = 0; at < body.length && !response.destroyed; at += packetBytes) {
      const packet = body.subarray(at, at + packetBytes);
      await this.#transmit(packet.length);
      response.write(packet);
    }
    response.end();
  }

  /** Resolves when `bytes` bytes have been sent. */
  async #transmit(bytes: number): Promise<void> {
    const now = performance.now();
    const begin = Math.max(this.#freeAt, now);
    if (this.#bytes === 0) this.#firstAt = begin;
    this.#bytes += bytes;
    this.#freeAt = begin + this.#msOf(bytes);
    await pause(this.#freeAt - now);
  }
}

async function pause(milliseconds: number): Promise<void> {
  if (milliseconds > 0) await new Promise((resolve) => setTimeout(resolve, milliseconds));
}
