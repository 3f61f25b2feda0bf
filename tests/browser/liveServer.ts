// The real server of a live stream, a process that tests kill and start again.

import { spawn, type ChildProcess } from "node:child_process";
import { once } from "node:events";
import { freePort } from "./freePort.ts";
import { until } from "./harness.ts";
import { converter } from "./paths.ts";

export interface LiveServer {
  /** The address of its stream. */
  readonly url: string;
  /** Starts the process and waits until it has a frame. */
  start(): Promise<void>;
  /** Ends the process as a crash does. */
  kill(): Promise<void>;
}

/** A server of a simulated cloth, which does not run yet. */
export async function liveServer(): Promise<LiveServer> {
  const port = await freePort();
  const url = `http://127.0.0.1:${port}/live/cloth`;
  let child: ChildProcess | undefined;
  const hasFrame = async (): Promise<boolean> => {
    const response = await fetch(`${url}/latest`).catch(() => undefined);
    return response?.ok === true && ((await response.json()) as { number: number | null }).number !== null;
  };
  return {
    url,
    async start() {
      child = spawn(converter, ["sample", "cloth", "--live", "--grid", "16", "--port", `${port}`], { stdio: "ignore" });
      await until("the server has a frame", hasFrame);
    },
    async kill() {
      if (child === undefined) return;
      const ended = once(child, "exit");
      child.kill("SIGKILL");
      child = undefined;
      await ended;
    },
  };
}
