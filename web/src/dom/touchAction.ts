// The CSS touch-action of a view. A view that handles all touch gestures keeps a page from being
// scrolled by touch; one that leaves vertical gestures to the page, as <model-viewer> does, cannot
// be turned up and down by touch. By default a view leaves vertical gestures to the page until it
// has the focus, by a tap or the keyboard, and handles all of them in a page that cannot scroll.

/** Values of CSS touch-action; `manipulation` leaves scrolling and pinching to the page. */
export type TouchAction = "none" | "pan-x" | "pan-y" | "manipulation";

/** Sets the canvas' touch-action until `signal` aborts. Call the returned function when `setting` may have changed. */
export function keepTouchAction(
  canvas: HTMLCanvasElement,
  setting: () => TouchAction | "auto",
  signal: AbortSignal,
): () => void {
  let hasFocus = false;
  const apply = () => {
    const chosen = setting();
    canvas.style.touchAction = chosen !== "auto" ? chosen : hasFocus || !canScroll() ? "none" : "pan-y";
  };
  const setFocus = (value: boolean) => () => {
    hasFocus = value;
    apply();
  };
  canvas.addEventListener("focus", setFocus(true), { signal });
  canvas.addEventListener("blur", setFocus(false), { signal });
  const resizeObserver = new ResizeObserver(apply);
  for (const element of [document.documentElement, document.body]) resizeObserver.observe(element);
  window.addEventListener("resize", apply, { signal });
  signal.addEventListener("abort", () => {
    resizeObserver.disconnect();
  });
  apply();
  return apply;
}

function canScroll(): boolean {
  const { scrollHeight, clientHeight } = document.scrollingElement ?? document.documentElement;
  return scrollHeight > clientHeight + 1; // sizes are rounded
}
