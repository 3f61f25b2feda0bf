// The worker's module, a file of its own beside the runtime. Where a page can
// start no workers, it imports this module and runs the jobs itself.

import { jobs } from "../decode/jobs.ts";
import type { JobMessage } from "./protocol.ts";
import { asAnswer, buffersIn } from "./protocol.ts";

export async function runJob({ name, input }: JobMessage): Promise<unknown> {
  const job = jobs[name] as (input: unknown) => Promise<unknown>;
  return job(input);
}

async function answer(message: JobMessage): Promise<void> {
  try {
    const output = await runJob(message);
    postMessage({ output }, { transfer: buffersIn(output) });
  } catch (error) {
    postMessage(asAnswer(error));
  }
}

if ("WorkerGlobalScope" in globalThis) {
  addEventListener("message", ({ data }) => {
    void answer(data as JobMessage);
  });
}
