// Viewers of a live stream in Node: the runtime's FrameSource over HTTP/1.1 or HTTP/2, each over connections of its
// own as browsers have them.

import { connect, type ClientHttp2Session } from "node:http2";
import { Agent as HttpAgent, request as requestPlainly, type IncomingHttpHeaders } from "node:http";
import { Agent, request } from "node:https";
import type { Readable } from "node:stream";
import { setTimeout as pause } from "node:timers/promises";
import { frameImages } from "../../web/src/decode/frame/frameImages.ts";
import { FrameSource } from "../../web/src/delivery/live/frameSource.ts";

export interface Viewer {
  /** Numbers of the frames that were displayed, each after its checksums were verified. */
  readonly shown: number[];
  /** Milliseconds from the moment at which the server had a frame to its display. */
  readonly ages: number[];
  readonly outages: Error[];
  skipped: number;
  stop(): void;
}

export interface ViewerOptions {
  /** The address of the stream. */
  readonly url: string;
  /** The server's, where the address begins with https:// */
  readonly certificate?: string;
  /** Default: false. */
  readonly isHttp2?: boolean;
}

export function startViewer(options: ViewerOptions): Viewer {
  const { url } = options;
  const transport = transportTo(options);
  const addedAt = new Map<number, number>();
  const source = new FrameSource(
    {
      url,
      fetch: async (target, init) => {
        const address = target as string;
        const answer = await transport.fetch(address, init?.signal ?? undefined);
        const location = answer.headers.get("location"); // of a frame that is gone
        const final = location === null ? address : new URL(location, address).href;
        const response = location === null ? answer : await transport.fetch(final, init?.signal ?? undefined);
        const added = response.headers.get("imgeo-added");
        if (added !== null) addedAt.set(Number(/\d+$/.exec(final)?.[0]), Number(added));
        return response;
      },
      decode: async (bytes) => ({ header: (await frameImages(bytes)).header, display: () => undefined }),
      now: () => performance.now(),
      delay: (ms, signal) => pause(ms, undefined, { signal }),
    },
    {
      onEpoch: () => undefined,
      onFrame: ({ header: { number } }, skipped) => {
        viewer.shown.push(number);
        viewer.skipped += skipped;
        // Viewers of tests run on the server's machine: the clocks are the same.
        viewer.ages.push(performance.timeOrigin + performance.now() - (addedAt.get(number) ?? NaN));
        addedAt.delete(number);
      },
      onOutage: (error) => viewer.outages.push(error),
    },
  );
  const viewer: Viewer = {
    shown: [],
    ages: [],
    outages: [],
    skipped: 0,
    stop: () => {
      source.stop();
      transport.close();
    },
  };
  source.start();
  return viewer;
}

interface Transport {
  fetch(url: string, signal?: AbortSignal): Promise<Response>;
  close(): void;
}

/** The connections of one viewer. */
export function transportTo({ url, certificate = "", isHttp2 = false }: ViewerOptions): Transport {
  return isHttp2 ? http2Transport(url, certificate) : http1Transport(url, certificate);
}

function http1Transport(stream: string, certificate: string): Transport {
  const isSecure = stream.startsWith("https:");
  const agent = isSecure ? new Agent({ keepAlive: true, ca: certificate }) : new HttpAgent({ keepAlive: true });
  const send = isSecure ? request : requestPlainly;
  return {
    fetch: (url, signal) =>
      new Promise((resolve, reject) => {
        const outgoing = send(url, { agent, signal }, (incoming) => {
          responseOf(incoming, incoming.statusCode ?? 0, incoming.headers).then(resolve, reject);
        });
        outgoing.once("error", reject);
        outgoing.end();
      }),
    close: () => {
      agent.destroy();
    },
  };
}

function http2Transport(url: string, certificate: string): Transport {
  let session: ClientHttp2Session | undefined;
  const open = (): ClientHttp2Session => {
    if (session === undefined || session.closed || session.destroyed) {
      session = connect(new URL(url).origin, { ca: certificate });
      session.on("error", () => undefined); // its requests fail, too
    }
    return session;
  };
  return {
    fetch: (target, signal) =>
      new Promise((resolve, reject) => {
        const { pathname, search } = new URL(target);
        const stream = open().request({ ":path": pathname + search }, { signal });
        stream.once("response", (headers) => {
          responseOf(stream, headers[":status"] ?? 0, headers).then(resolve, reject);
        });
        stream.once("error", reject);
        stream.end();
      }),
    close: () => {
      session?.destroy();
    },
  };
}

/** Frames of tests are small: the head is passed on with the body. */
async function responseOf(body: Readable, status: number, headers: IncomingHttpHeaders): Promise<Response> {
  const chunks: Buffer[] = [];
  for await (const chunk of body) chunks.push(chunk as Buffer);
  const fields = Object.entries(headers).filter(([name, value]) => !name.startsWith(":") && typeof value === "string");
  return new Response(Buffer.concat(chunks), { status, headers: fields as [string, string][] });
}
