/**
 * Calls back with the protocol of the scene's files ("http/1.1", "h2", …), and whenever it
 * changes. Until the first file has been fetched, other resources from the page's own origin
 * count too, since files are usually served from there.
 */
export function watchNetworkProtocol(signal: AbortSignal, onProtocol: (protocol: string) => void): void {
  let protocol = "";
  let hasFile = false;
  const observer = new PerformanceObserver((list) => {
    for (const { name, initiatorType, nextHopProtocol } of list.getEntries() as PerformanceResourceTiming[]) {
      const isFile = initiatorType === "fetch";
      // Empty for cached files, and for origins without Timing-Allow-Origin.
      if (nextHopProtocol === "" || !(isFile || (!hasFile && new URL(name).origin === location.origin))) continue;
      hasFile ||= isFile;
      if (nextHopProtocol === protocol) continue;
      protocol = nextHopProtocol;
      onProtocol(protocol);
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
