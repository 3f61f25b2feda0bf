// An HTTP server for tests: it serves directories and single bodies, records every request, and fails, holds, delays,
// truncates or replaces the answers to requests that match a rule. By default it sends everything with
// `Content-Security-Policy: default-src 'self'`, so every test that loads a page of imgeo proves that the page needs
// no more.

import { readFile } from "node:fs/promises";
import { createServer, type IncomingMessage, type ServerResponse } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";
import { NetworkLink, type LinkOptions, type LinkUsage } from "./networkLink.ts";

export interface RequestRecord {
  /** "GET", or "HEAD" where only headers were asked for. */
  method: string;
  /** Decoded path, without the query. */
  path: string;
  /** HTTP status; 0 until answered, and if the client disconnected first. */
  status: number;
  state: "waiting" | "answered" | "aborted";
}

/** How the server treats a request whose path matches. The members combine. */
export interface Behaviour {
  /** Answers with this status and an empty body. */
  status?: number;
  /** Closes the connection without an answer. */
  drop?: boolean;
  /** Waits until this resolves. */
  hold?: Promise<unknown>;
  delayMs?: number;
  /** Sends only the first `truncateTo` bytes of the body, as if the file ended there. */
  truncateTo?: number;
  /** Additional headers; they override the default ones. */
  headers?: Record<string, string>;
  /** Changes the body. */
  replace?: (body: Buffer) => Buffer | string;
  /** Answers in place of the files, when it resolves. */
  answer?: (path: string) => Promise<Answer>;
}

export interface Answer {
  status: number;
  headers?: Record<string, string>;
  body?: Buffer | string;
}

export interface TestServer {
  /** "http://127.0.0.1:PORT/" */
  origin: string;
  /** Every request in order of arrival. */
  requests: RequestRecord[];
  /** Bytes of all bodies sent so far. */
  bytesSent: number;
  /** Sets the network link between the server and its clients; by default there is none. */
  useLink(options: LinkOptions | undefined): void;
  /** What the network link has carried since the last call; undefined without a link. */
  takeLinkUsage(): LinkUsage | undefined;
  /** Sends this body with `Content-Encoding` to clients that accept the encoding. */
  putEncoded(path: string, encoding: "br" | "gzip", body: Buffer): void;
  /** Content-Security-Policy of every answer. The default is the strictest; pages of other runtimes need more. */
  contentPolicy: string;
  /** Serves `body` at `path`, which begins with "/". */
  put(path: string, body: Buffer | string): void;
  /** Adds a rule; the latest rule that matches a path applies. Returns a function that removes the rule. */
  when(matches: RegExp | ((path: string) => boolean), behaviour: Behaviour): () => void;
  /** The records of the paths that match. */
  requestsOf(matches: RegExp): RequestRecord[];
  close(): Promise<void>;
}

const mediaTypes: Record<string, string> = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".x3d": "model/x3d+xml",
  ".png": "image/png",
  ".json": "application/json",
  ".wasm": "application/wasm",
};

/** Serves `directory` as "/" on a free port of 127.0.0.1. */
export async function startServer(directory: string): Promise<TestServer> {
  const requests: RequestRecord[] = [];
  const bodies = new Map<string, Buffer>();
  const encoded = new Map<string, { encoding: string; body: Buffer }>();
  let link: NetworkLink | undefined;
  const rules: { matches: (path: string) => boolean; behaviour: Behaviour }[] = [];

  async function answer(request: IncomingMessage, response: ServerResponse): Promise<void> {
    const path = decodeURIComponent(new URL(request.url ?? "/", "http://localhost").pathname);
    if (path === "/favicon.ico") {
      // Chromium requests it without the page.
      response.writeHead(204).end();
      return;
    }
    const record: RequestRecord = { method: request.method ?? "GET", path, status: 0, state: "waiting" };
    requests.push(record);
    response.on("close", () => {
      if (!response.writableFinished) record.state = "aborted";
    });
    const behaviour = rules.findLast((rule) => rule.matches(path))?.behaviour ?? {};
    await link?.arrive(request);
    await behaviour.hold;
    if (behaviour.delayMs !== undefined) await new Promise((resolve) => setTimeout(resolve, behaviour.delayMs));
    if (record.state === "aborted") return;
    if (behaviour.drop) {
      request.socket.destroy();
      return;
    }
    const made = await behaviour.answer?.(path);
    const file = behaviour.status === undefined && made === undefined ? await bodyOf(path, behaviour) : undefined;
    const body = made?.body === undefined ? file : Buffer.from(made.body);
    record.status = behaviour.status ?? made?.status ?? (body ? 200 : 404);
    response.on("finish", () => (record.state = "answered"));
    const packed = Object.keys(behaviour).length === 0 ? encodedFor(request, path) : undefined;
    const sent = (request.method === "HEAD" ? undefined : (packed?.body ?? body)) ?? Buffer.alloc(0);
    response.writeHead(record.status, {
      "Content-Type": mediaTypes[extname(path) || ".html"] ?? "application/octet-stream",
      "Content-Length": sent.length,
      "Content-Security-Policy": testServer.contentPolicy,
      "Cache-Control": "no-cache",
      ...(packed && { "Content-Encoding": packed.encoding }),
      ...behaviour.headers,
      ...made?.headers,
    });
    testServer.bytesSent += sent.length;
    if (link) await link.send(response, sent);
    else response.end(sent);
  }

  function encodedFor(request: IncomingMessage, path: string): { encoding: string; body: Buffer } | undefined {
    const packed = encoded.get(path);
    return packed && String(request.headers["accept-encoding"]).includes(packed.encoding) ? packed : undefined;
  }

  async function bodyOf(path: string, behaviour: Behaviour): Promise<Buffer | undefined> {
    const file = join(directory, normalize(path.endsWith("/") ? `${path}index.html` : path));
    const whole = bodies.get(path) ?? (await readFile(file).catch(() => undefined));
    const changed = whole && behaviour.replace ? Buffer.from(behaviour.replace(whole)) : whole;
    return changed?.subarray(0, behaviour.truncateTo ?? changed.length);
  }

  const server = createServer((request, response) => void answer(request, response));
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  // A test that fails before it closes its server would otherwise keep the run from ending.
  server.unref();
  const testServer: TestServer = {
    contentPolicy: "default-src 'self'",
    origin: `http://127.0.0.1:${(server.address() as AddressInfo).port}/`,
    requests,
    bytesSent: 0,
    useLink: (options) => void (link = options && new NetworkLink(options)),
    takeLinkUsage: () => link?.takeUsage(),
    putEncoded: (path, encoding, body) => void encoded.set(path, { encoding, body }),
    put: (path, body) => void bodies.set(path, Buffer.from(body)),
    when(matches, behaviour) {
      const rule = { matches: matches instanceof RegExp ? (path: string) => matches.test(path) : matches, behaviour };
      rules.push(rule);
      return () => void rules.splice(rules.indexOf(rule), 1);
    },
    requestsOf: (matches) => requests.filter((record) => matches.test(record.path)),
    async close() {
      server.closeAllConnections();
      await new Promise((resolve) => server.close(resolve));
    },
  };
  return testServer;
}

/** A promise for `hold`, and the function that resolves it. */
export function gate(): { closed: Promise<unknown>; open: () => void } {
  const { promise, resolve } = Promise.withResolvers<undefined>();
  return {
    closed: promise,
    open: () => {
      resolve(undefined);
    },
  };
}
