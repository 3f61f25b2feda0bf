// Which finger movements are the page's. A view that takes them all is a trap in
// a page that scrolls; one that leaves the page what runs up and down, as
// <model-viewer> does, cannot be turned over the top. So by itself it is the
// latter until a tap, or the keyboard, gives it the focus, and where there is
// nothing to scroll it takes them all.

/** Of CSS; `manipulation` leaves the page all that it has. */
export type TouchAction = "none" | "pan-x" | "pan-y" | "manipulation";

/** Keeps the canvas' style; the function that comes back says that `setting` may tell another. "auto": as is best. */
export function keepTouchAction(
  canvas: HTMLCanvasElement,
  setting: () => TouchAction | "auto",
  signal: AbortSignal,
): () => void {
  let hasFocus = false;
  const apply = () => {
    const wanted = setting();
    canvas.style.touchAction = wanted !== "auto" ? wanted : hasFocus || !canScroll() ? "none" : "pan-y";
  };
  const focus = (now: boolean) => () => {
    hasFocus = now;
    apply();
  };
  canvas.addEventListener("focus", focus(true), { signal });
  canvas.addEventListener("blur", focus(false), { signal });
  const onSize = new ResizeObserver(apply);
  for (const element of [document.documentElement, document.body]) onSize.observe(element);
  window.addEventListener("resize", apply, { signal });
  signal.addEventListener("abort", () => {
    onSize.disconnect();
  });
  apply();
  return apply;
}

function canScroll(): boolean {
  const { scrollHeight, clientHeight } = document.scrollingElement ?? document.documentElement;
  return scrollHeight > clientHeight + 1; // sizes are rounded
}
