// Starts `imgeo sample MOTION --live` for tests and benchmarks.

import { spawn } from "node:child_process";
import { once } from "node:events";
import { createInterface } from "node:readline";

export interface LiveStream {
  readonly port: number;
  /** The number of the process. */
  readonly pid: number;
  stop(): Promise<void>;
}

/** Resolves when the server listens. `command`: the tool and what precedes it, such as taskset. */
export async function startStream(options: readonly string[], command = ["build/imgeo"]): Promise<LiveStream> {
  const [program, ...words] = [...command, "sample", ...options, "--live", "--port", "0"];
  const child = spawn(program, words, { stdio: ["ignore", "pipe", "ignore"] });
  const [line] = (await once(createInterface(child.stdout), "line")) as [string];
  return {
    port: Number(/:(\d+)\/live/.exec(line)?.[1]),
    pid: child.pid ?? 0,
    stop: async () => {
      const ended = once(child, "exit");
      child.kill("SIGINT");
      await ended;
    },
  };
}
