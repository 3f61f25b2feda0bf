// A display without a screen: Firefox and WebKit have no WebGL without one.

import type { ChildProcess } from "node:child_process";
import { spawn } from "node:child_process";

export interface Display {
  /** The environment of programs that draw on it, by Mesa's software renderer. */
  readonly environment: NodeJS.ProcessEnv;
  close(): void;
}

export async function startDisplay(): Promise<Display> {
  const server = spawn(
    "Xvfb",
    ["-displayfd", "1", "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "+extension", "GLX"],
    { stdio: ["ignore", "pipe", "ignore"] },
  );
  process.once("exit", () => server.kill()); // also where a browser could not be started
  const number = await lineOf(server, server.stdout, /^(\d+)\n/);
  return {
    environment: { ...process.env, DISPLAY: `:${number}`, LIBGL_ALWAYS_SOFTWARE: "1" },
    close() {
      server.kill();
    },
  };
}

/** What a program's output has at a pattern's first group. Rejects if it ends before, or cannot be started. */
export function lineOf(program: ChildProcess, output: NodeJS.ReadableStream, pattern: RegExp): Promise<string> {
  return new Promise((resolve, reject) => {
    let text = "";
    output.on("data", (data: Buffer) => {
      text += data.toString();
      const found = pattern.exec(text)?.[1];
      if (found !== undefined) resolve(found);
    });
    program.on("error", reject);
    program.on("exit", () => {
      reject(new Error(`${program.spawnfile} ended: ${text}`));
    });
  });
}
