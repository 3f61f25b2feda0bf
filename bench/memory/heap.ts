// The JavaScript heap of a page and its workers after a garbage collection, with the memory of array buffers, as V8 states
// it.

import type { CDPSession, Page } from "playwright-core";

interface HeapUsage {
  usedSize: number;
  backingStorageSize?: number;
  embedderHeapUsedSize?: number;
}

/** Bytes of the heap of a page or worker after a garbage collection. */
async function heapOf(send: (method: "HeapProfiler.collectGarbage" | "Runtime.getHeapUsage") => Promise<unknown>) {
  await send("HeapProfiler.collectGarbage");
  const { usedSize, backingStorageSize = 0 } = (await send("Runtime.getHeapUsage")) as HeapUsage;
  return usedSize + backingStorageSize;
}

/** The same of a page's workers. */
async function heapOfWorkers(session: CDPSession): Promise<number> {
  const sessions: string[] = [];
  session.on("Target.attachedToTarget", ({ sessionId, targetInfo }) => {
    if (targetInfo.type === "worker") sessions.push(sessionId);
  });
  let lastId = 0;
  const answers = new Map<number, (result: unknown) => void>();
  session.on("Target.receivedMessageFromTarget", ({ message }) => {
    const { id, result } = JSON.parse(message) as { id: number; result: unknown };
    answers.get(id)?.(result);
  });
  await session.send("Target.setAutoAttach", { autoAttach: true, waitForDebuggerOnStart: false, flatten: false });
  let sum = 0;
  for (const sessionId of sessions)
    sum += await heapOf(
      (method) =>
        new Promise((resolve, reject) => {
          const id = ++lastId;
          answers.set(id, resolve);
          session
            .send("Target.sendMessageToTarget", { sessionId, message: JSON.stringify({ id, method }) })
            .catch(reject);
        }),
    );
  return sum;
}

/** Bytes of the heaps of the page and of its workers. */
export async function heapBytes(page: Page): Promise<number> {
  const session = await page.context().newCDPSession(page);
  const workers = await heapOfWorkers(session);
  const own = await heapOf((method) => session.send(method));
  await session.detach();
  return workers + own;
}
