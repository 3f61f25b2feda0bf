// A slow line between a server and its clients: bytes of all connections share
// its width, and every answer begins a round trip late.

import type { IncomingMessage, ServerResponse } from "node:http";
import type { Socket } from "node:net";

export interface LinkOptions {
  bitsPerSecond: number;
  roundTripMs: number;
}

/** Small enough that connections take turns on a slow line, large enough for node's timers on a fast one. */
const packetBytes = 4096;
/** Status line and headers, roughly. */
const headBytes = 300;

export class NetworkLink {
  readonly #options: LinkOptions;
  readonly #greeted = new WeakSet<Socket>();
  /** When the line will have sent what has been given to it. */
  #freeAt = 0;

  constructor(options: LinkOptions) {
    this.#options = options;
  }

  /** The time until the server's first byte can be here; a new connection takes a round trip of its own. */
  async arrive({ socket }: IncomingMessage): Promise<void> {
    const isNew = !this.#greeted.has(socket);
    this.#greeted.add(socket);
    await pause((isNew ? 2 : 1) * this.#options.roundTripMs);
    await this.#turn(headBytes);
  }

  /** Sends the body as fast as the line allows; stops where the client goes away. */
  async send(response: ServerResponse, body: Uint8Array): Promise<void> {
    for (let at = 0; at < body.length && !response.destroyed; at += packetBytes) {
      const packet = body.subarray(at, at + packetBytes);
      await this.#turn(packet.length);
      response.write(packet);
    }
    response.end();
  }

  /** Resolves when so many bytes have passed. */
  async #turn(bytes: number): Promise<void> {
    const now = performance.now();
    this.#freeAt = Math.max(this.#freeAt, now) + (8000 * bytes) / this.#options.bitsPerSecond;
    await pause(this.#freeAt - now);
  }
}

async function pause(milliseconds: number): Promise<void> {
  if (milliseconds > 0) await new Promise((resolve) => setTimeout(resolve, milliseconds));
}
