// WebKitGTK's MiniBrowser, which has the engine of Safari, by WebDriver (https://www.w3.org/TR/webdriver2/).

import { spawn } from "node:child_process";
import { globSync } from "node:fs";
import { createServer } from "node:net";
import type { AddressInfo } from "node:net";
import { startDisplay } from "./display.ts";
import type { Engine, EnginePage, Size } from "./engine.ts";
import { dragActions } from "./engine.ts";

const scriptTimeoutMs = 120_000;

async function freePort(): Promise<number> {
  const server = createServer().listen(0, "127.0.0.1");
  await new Promise((resolve) => server.once("listening", resolve));
  const { port } = server.address() as AddressInfo;
  await new Promise((resolve) => server.close(resolve));
  return port;
}

type Call = (method: "GET" | "POST" | "DELETE", path: string, body?: object) => Promise<unknown>;

/** Sends commands to the driver, which may still be starting. */
function callsTo(port: number): Call {
  return async (method, path, body) => {
    const request = { method, ...(body && { body: JSON.stringify(body) }) };
    let response: Response | undefined;
    for (const end = Date.now() + 20_000; response === undefined;)
      response = await fetch(`http://127.0.0.1:${port}${path}`, request).catch(async (error: unknown) => {
        if (Date.now() > end) throw error;
        await new Promise((resolve) => setTimeout(resolve, 100));
        return undefined;
      });
    const { value } = (await response.json()) as { value: { error?: string; message?: string } | null };
    if (!response.ok) throw new Error(`${value?.error}: ${value?.message}`);
    return value;
  };
}

async function open({ width, height }: Size): Promise<EnginePage> {
  const display = await startDisplay();
  const port = await freePort();
  const driver = spawn("WebKitWebDriver", [`--port=${port}`], {
    // Its sandbox needs what containers refuse; its pages come from the test's own server.
    env: { ...display.environment, WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS: "1" },
    stdio: "ignore",
  });
  const hasEnded = new Promise((resolve) => driver.once("exit", resolve));
  driver.once("error", () => undefined); // the first command fails
  const call = callsTo(port);
  const [binary] = globSync("/usr/lib/*/webkit2gtk-4.1/MiniBrowser");
  const { sessionId } = (await call("POST", "/session", {
    capabilities: { alwaysMatch: { "webkitgtk:browserOptions": { binary, args: ["--automation"] } } },
  })) as { sessionId: string };
  const session = `/session/${sessionId}`;
  await call("POST", `${session}/timeouts`, { script: scriptTimeoutMs });
  const evaluate = async (expression: string): Promise<unknown> => {
    const script = `const done = arguments[0];
      Promise.resolve(${expression}).then((value) => done({ value }), (error) => done({ error: String(error) }));`;
    const answer = (await call("POST", `${session}/execute/async`, { script, args: [] })) as {
      readonly value?: unknown;
      readonly error?: string;
    };
    if (answer.error !== undefined) throw new Error(answer.error);
    return answer.value;
  };
  // The window has bars around the page.
  await call("POST", `${session}/window/rect`, { width, height });
  const [barsX, barsY] = (await evaluate(`[${width} - innerWidth, ${height} - innerHeight]`)) as [number, number];
  await call("POST", `${session}/window/rect`, { width: width + barsX, height: height + barsY });
  return {
    async goTo(url) {
      await call("POST", `${session}/url`, { url });
    },
    evaluate,
    async picture() {
      return Buffer.from((await call("GET", `${session}/screenshot`)) as string, "base64");
    },
    async drag(points) {
      await call("POST", `${session}/actions`, { actions: dragActions(points) });
    },
    async close() {
      await call("DELETE", session);
      driver.kill();
      await hasEnded;
      display.close();
    },
  };
}

export const webkit: Engine = { name: "WebKit", open };
