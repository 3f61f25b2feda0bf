// Whether the page is visible: streams rest while nobody can see them.

/** False where there is no page, as in tests. */
export function isPageHidden(): boolean {
  return typeof document !== "undefined" && document.hidden;
}

/** Calls `listener` whenever the page becomes visible or hidden, until the returned function is called. */
export function onPageVisibility(listener: () => void): () => void {
  if (typeof document === "undefined") return () => undefined;
  document.addEventListener("visibilitychange", listener);
  return () => {
    document.removeEventListener("visibilitychange", listener);
  };
}
