/** Tells over which protocol files come ("http/1.1", "h2", …), when the first has come and whenever it changes. */
export function watchProtocol(signal: AbortSignal, onProtocol: (protocol: string) => void): void {
  let known = "";
  const observer = new PerformanceObserver((list) => {
    for (const { initiatorType, nextHopProtocol } of list.getEntries() as PerformanceResourceTiming[]) {
      // Empty for files of the cache, and for origins that do not want it told.
      if (initiatorType !== "fetch" || nextHopProtocol === "" || nextHopProtocol === known) continue;
      known = nextHopProtocol;
      onProtocol(known);
    }
  });
  observer.observe({ type: "resource", buffered: true });
  signal.addEventListener("abort", () => { observer.disconnect(); }, { once: true });
}
