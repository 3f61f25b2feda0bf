// A response that does not end.

export interface EndlessBody {
  readonly body: ReadableStream<Uint8Array<ArrayBuffer>>;
  readonly sentBytes: number;
  readonly isCancelled: boolean;
}

/** Sends `chunk` again and again until it is cancelled. */
export function endlessBody(chunk: Uint8Array<ArrayBuffer>): EndlessBody {
  let sentBytes = 0;
  let isCancelled = false;
  const body = new ReadableStream<Uint8Array<ArrayBuffer>>({
    pull: (controller) => {
      sentBytes += chunk.length;
      controller.enqueue(chunk);
    },
    cancel: () => {
      isCancelled = true;
    },
  });
  return {
    body,
    get sentBytes() {
      return sentBytes;
    },
    get isCancelled() {
      return isCancelled;
    },
  };
}
