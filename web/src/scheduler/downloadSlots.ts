// The number of parallel downloads: few, so that the most important ones get the whole bandwidth and the order can
// still change (paper section 5.4), but enough that the connection is never idle while a response is on its way.

/**
 * HTTP/1.1: browsers open six connections to a host, each for one request at a time. Further requests would wait in
 * the browser, where their order cannot change any more.
 */
export const http1SlotCount = 6;

/**
 * HTTP/2 and HTTP/3 carry all requests on one connection. Sixteen files of 20 kB, a patch's usual size, are 320 kB:
 * three times what a connection of 20 Mbit/s carries in 40 ms.
 */
export const http2SlotCount = 16;

/** Before the runtime has been loaded. Leaves connections for the runtime's own modules, however slow an answer is. */
export const earlySlotCount = 3;

/** `protocol` is a PerformanceResourceTiming's `nextHopProtocol`; "" where the browser does not say. */
export function slotCountFor(protocol: string): number {
  return /^(h2|h3)/.test(protocol) ? http2SlotCount : http1SlotCount;
}
