// The entry module of workers, a file of its own next to the runtime. A page that cannot start workers imports it and
// runs the jobs on its main thread.

import { useWasm } from "../decode/compact/decodeFile.ts";
import { jobs } from "../decode/jobs.ts";
import type { DecoderMessage, JobMessage } from "./protocol.ts";
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

/** Compiles the decoder while jobs run. Where that is not possible, jobs go on with TypeScript. */
async function receive({ decoder }: DecoderMessage): Promise<void> {
  try {
    useWasm(await WebAssembly.compile(decoder));
  } catch {
    // See above.
  }
}

if ("WorkerGlobalScope" in globalThis) {
  addEventListener("message", ({ data }) => {
    const message = data as JobMessage | DecoderMessage;
    void ("decoder" in message ? receive(message) : answer(message));
  });
}
