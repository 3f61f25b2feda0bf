/**
 * Tells over which protocol files come ("http/1.1", "h2", …), and whenever that changes. Until a file has come,
 * whatever else has come from the page's own host tells, which is where files lie as a rule.
 */
export function watchNetworkProtocol(signal: AbortSignal, onProtocol: (protocol: string) => void): void {
  let known = "";
  let isOfFiles = false;
  const observer = new PerformanceObserver((list) => {
    for (const { name, initiatorType, nextHopProtocol } of list.getEntries() as PerformanceResourceTiming[]) {
      const isFile = initiatorType === "fetch";
      // Empty for files of the cache, and for origins that do not want it told.
      if (nextHopProtocol === "" || !(isFile || (!isOfFiles && new URL(name).origin === location.origin))) continue;
      isOfFiles ||= isFile;
      if (nextHopProtocol === known) continue;
      known = nextHopProtocol;
      onProtocol(known);
    }
  });
  observer.observe({ type: "resource", buffered: true });
  signal.addEventListener(
    "abort",
    () => {
      observer.disconnect();
    },
    { once: true },
  );
}
