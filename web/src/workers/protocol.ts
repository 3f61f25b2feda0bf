// The messages between pages and workers.

import { DecodeError } from "../decode/decodeError.ts";
import type { JobName } from "../decode/jobs.ts";

export interface JobMessage {
  readonly name: JobName;
  readonly input: unknown;
}

/** A job whose input is a file, which the worker takes from the browser's cache, or requests. */
export interface FileJobMessage {
  readonly name: JobName;
  /** Absolute. */
  readonly fileUrl: string;
}

/** The jobs that WebAssembly can do. */
export const decoderJobs: ReadonlySet<JobName> = new Set<JobName>(["compactPatches", "compactBases", "compactGroup"]);

/** The URL of the WebAssembly module that decodes compact as soon as it is there. A worker does not answer it. */
export interface DecoderMessage {
  readonly decoderUrl: string;
}

export type WorkerMessage = JobMessage | FileJobMessage | DecoderMessage;

/**
 * The URL of a worker's script with the messages that the worker receives first. Those that a page posts are delivered
 * only when the page's thread is free.
 */
export function withMessages(scriptUrl: URL, messages: readonly (FileJobMessage | DecoderMessage)[]): URL {
  const url = new URL(scriptUrl);
  if (messages.length > 0) url.hash = encodeURIComponent(JSON.stringify(messages));
  return url;
}

/** The messages in the fragment of a worker's own URL. */
export function messagesIn(hash: string): readonly (FileJobMessage | DecoderMessage)[] {
  return hash === "" ? [] : (JSON.parse(decodeURIComponent(hash.slice(1))) as (FileJobMessage | DecoderMessage)[]);
}

export type AnswerMessage =
  | { readonly output: unknown }
  | { readonly error: { readonly kind: DecodeError["kind"] | undefined; readonly message: string } };

/** The message for an error. It carries the kind of a DecodeError, because errors lose their class in messages. */
export function asAnswer(error: unknown): AnswerMessage {
  const message = error instanceof Error ? error.message : String(error);
  return { error: { kind: error instanceof DecodeError ? error.kind : undefined, message } };
}

export function asError({ error: { kind, message } }: Extract<AnswerMessage, { error: unknown }>): Error {
  return kind === undefined ? new Error(message) : new DecodeError(kind, message);
}

/** The buffers of all arrays in plain data, to be transferred instead of copied. */
export function buffersIn(value: unknown, found = new Set<ArrayBuffer>()): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) {
    if (value.buffer instanceof ArrayBuffer) found.add(value.buffer);
  } else if (value !== null && typeof value === "object") {
    for (const member of Object.values(value)) buffersIn(member, found);
  }
  return Array.from(found);
}
