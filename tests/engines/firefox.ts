// Debian's Firefox, by WebDriver BiDi (https://www.w3.org/TR/webdriver-bidi/), which it speaks without a driver.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { lineOf, startDisplay } from "./display.ts";
import type { Engine, EnginePage, Size } from "./engine.ts";
import { dragActions } from "./engine.ts";

/** Firefox requests nothing by itself. */
const preferences = {
  "app.update.enabled": false,
  "browser.shell.checkDefaultBrowser": false,
  "datareporting.policy.dataSubmissionEnabled": false,
  "toolkit.telemetry.enabled": false,
  "webgl.force-enabled": true,
};

interface Answer {
  readonly id?: number;
  readonly type: "success" | "error" | "event";
  readonly result?: Record<string, unknown>;
  readonly error?: string;
  readonly message?: string;
}

/** A connection, which sends commands and resolves with their results. */
class Connection {
  readonly #socket: WebSocket;
  readonly #waiting = new Map<number, PromiseWithResolvers<Record<string, unknown>>>();
  #count = 0;

  static async open(url: string): Promise<Connection> {
    const socket = new WebSocket(url);
    await new Promise((resolve, reject) => {
      socket.onopen = resolve;
      socket.onerror = reject;
    });
    return new Connection(socket);
  }

  private constructor(socket: WebSocket) {
    this.#socket = socket;
    socket.onmessage = ({ data }) => {
      const { id, type, result, error, message } = JSON.parse(String(data)) as Answer;
      if (id === undefined) return;
      const waiting = this.#waiting.get(id);
      this.#waiting.delete(id);
      if (type === "error") waiting?.reject(new Error(`${error}: ${message}`));
      else waiting?.resolve(result ?? {});
    };
  }

  send(method: string, params: object = {}): Promise<Record<string, unknown>> {
    const id = ++this.#count;
    const waiting = Promise.withResolvers<Record<string, unknown>>();
    this.#waiting.set(id, waiting);
    this.#socket.send(JSON.stringify({ id, method, params }));
    return waiting.promise;
  }

  close(): void {
    this.#socket.close();
  }
}

interface Evaluation {
  readonly type: "success" | "exception";
  readonly result?: { readonly value?: string };
  readonly exceptionDetails?: { readonly text: string };
}

async function open(size: Size): Promise<EnginePage> {
  const display = await startDisplay();
  const profile = mkdtempSync(join(tmpdir(), "imgeo-firefox-"));
  const lines = Object.entries(preferences).map(([name, value]) => `user_pref("${name}", ${value});\n`);
  writeFileSync(join(profile, "user.js"), lines.join(""));
  const firefox = spawn("firefox-esr", ["--no-remote", "--profile", profile, "--remote-debugging-port", "0"], {
    env: { ...display.environment, HOME: profile },
    stdio: ["ignore", "ignore", "pipe"],
  });
  const url = await lineOf(firefox, firefox.stderr, /(ws:\/\/\S+)/);
  const connection = await Connection.open(`${url}/session`);
  await connection.send("session.new", { capabilities: {} });
  const { contexts } = (await connection.send("browsingContext.getTree")) as { contexts: { context: string }[] };
  const context = contexts[0]?.context;
  await connection.send("browsingContext.setViewport", { context, viewport: size });
  return {
    async goTo(address) {
      await connection.send("browsingContext.navigate", { context, url: address, wait: "complete" });
    },
    async evaluate(expression) {
      // As JSON, since BiDi describes each value.
      const { type, result, exceptionDetails } = (await connection.send("script.evaluate", {
        expression: `Promise.resolve(${expression}).then((value) => JSON.stringify(value ?? null))`,
        target: { context },
        awaitPromise: true,
      })) as unknown as Evaluation;
      if (type === "exception") throw new Error(exceptionDetails?.text);
      return JSON.parse(result?.value ?? "null") as unknown;
    },
    async picture() {
      const { data } = await connection.send("browsingContext.captureScreenshot", { context });
      return Buffer.from(data as string, "base64");
    },
    async drag(points) {
      await connection.send("input.performActions", { context, actions: dragActions(points) });
    },
    async close() {
      const hasEnded = new Promise((resolve) => firefox.once("exit", resolve));
      connection.close();
      firefox.kill();
      await hasEnded;
      display.close();
      rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
    },
  };
}

export const firefox: Engine = { name: "Firefox", open };
