// The entry module of workers, a file of its own next to the runtime. A page that cannot start workers imports it and
// runs the jobs on its main thread.

import { useWasm } from "../decode/compact/decodeFile.ts";
import { jobs } from "../decode/jobs.ts";
import { fetchDecoder } from "./fetchDecoder.ts";
import { fetchFile } from "./fetchFile.ts";
import type { DecoderMessage, FileJobMessage, JobMessage, WorkerMessage } from "./protocol.ts";
import { asAnswer, buffersIn, decoderJobs, messagesIn } from "./protocol.ts";

/**
 * Files of at least this many bytes wait for the module, so long at most. TypeScript is cold then, and takes longer for
 * such a file than the wait and the module together, most of it for the engine's compilers, which keep the page and the
 * other workers from the processor.
 */
const minWaitingBytes = 32 * 1024;
const maxWaitMs = 250;

/** Resolves when a large file need not wait for the module any longer. */
let decoderWait: Promise<unknown> | undefined;

export async function runJob({ name, input }: JobMessage): Promise<unknown> {
  const job = jobs[name] as (input: unknown) => Promise<unknown>;
  return job(input);
}

async function answer(message: JobMessage | FileJobMessage): Promise<void> {
  try {
    const job = "fileUrl" in message ? { name: message.name, input: await fetchFile(message.fileUrl) } : message;
    if (decoderWait && waitsForDecoder(job)) await decoderWait;
    const output = await runJob(job);
    postMessage({ output }, { transfer: buffersIn(output) });
  } catch (error) {
    postMessage(asAnswer(error));
  }
}

function waitsForDecoder({ name, input }: JobMessage): boolean {
  return decoderJobs.has(name) && input instanceof Uint8Array && input.byteLength >= minWaitingBytes;
}

/** Fetches the module while jobs run. Where that is not possible, they go on with TypeScript. */
async function useDecoder({ decoderUrl }: DecoderMessage): Promise<void> {
  const module = await fetchDecoder(new URL(location.href), new URL(decoderUrl));
  if (module) useWasm(module);
}

function receive(message: WorkerMessage): void {
  if ("decoderUrl" in message)
    decoderWait = Promise.race([useDecoder(message), new Promise((resolve) => setTimeout(resolve, maxWaitMs))]);
  else void answer(message);
}

if ("WorkerGlobalScope" in globalThis) {
  addEventListener("message", ({ data }) => {
    receive(data as WorkerMessage);
  });
  messagesIn(location.hash).forEach(receive);
}
