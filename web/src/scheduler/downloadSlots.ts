// How many downloads at a time: few, so that what matters most gets the whole
// line and the order can still change (paper section 5.4), but enough that the
// line is never idle while an answer is on its way.

/**
 * HTTP/1.1: browsers open six connections to a host, each for one request at a
 * time; what is committed beyond that waits in the browser, out of our hands.
 */
export const http1SlotCount = 6;

/**
 * HTTP/2 and 3 carry all requests on one connection. Sixteen files of a patch's
 * usual 20 kB are 320 kB, three times what a line of 20 Mbit/s holds in 40 ms.
 */
export const http2SlotCount = 16;

/** `protocol` is a PerformanceResourceTiming's `nextHopProtocol`; "" where the browser may not tell. */
export function slotCountFor(protocol: string): number {
  return /^(h2|h3)/.test(protocol) ? http2SlotCount : http1SlotCount;
}
