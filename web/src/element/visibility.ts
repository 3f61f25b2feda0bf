// Where an element is in the page's viewport, and its size in device pixels.

/**
 * Calls back once, when the element is within `margin` viewport sizes of the viewport; synchronously if it already is.
 */
export function whenNearViewport(element: Element, margin: number, signal: AbortSignal, onNear: () => void): void {
  if (isNearViewport(element.getBoundingClientRect(), margin)) {
    onNear();
    return;
  }
  const observer = new IntersectionObserver(
    (entries) => {
      if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
      observer.disconnect();
      onNear();
    },
    { rootMargin: `${margin * 100}%` },
  );
  observer.observe(element);
  signal.addEventListener("abort", () => {
    observer.disconnect();
  });
}

/** Whether a rectangle has an area and is within `margin` viewport sizes of the viewport. */
export function isNearViewport({ left, right, top, bottom, width, height }: DOMRect, margin: number): boolean {
  return (
    width > 0 &&
    height > 0 &&
    right >= -margin * innerWidth &&
    left <= (1 + margin) * innerWidth &&
    bottom >= -margin * innerHeight &&
    top <= (1 + margin) * innerHeight
  );
}

/**
 * Calls back with the element's size in device pixels, soon after the call and whenever the size or the pixel ratio
 * changes.
 */
export function observeDeviceSize(
  element: Element,
  signal: AbortSignal,
  onSize: (width: number, height: number, ratio: number) => void,
): void {
  const observer = new ResizeObserver((entries) => {
    for (const { contentRect, devicePixelContentBoxSize } of entries) {
      // Not every browser supports device pixels here.
      const exact = (devicePixelContentBoxSize as readonly ResizeObserverSize[] | undefined)?.[0];
      onSize(
        devicePixels(contentRect.width, exact?.inlineSize),
        devicePixels(contentRect.height, exact?.blockSize),
        devicePixelRatio,
      );
    }
  });
  try {
    observer.observe(element, { box: "device-pixel-content-box" });
  } catch {
    observer.observe(element);
  }
  signal.addEventListener("abort", () => {
    observer.disconnect();
  });
}

/** The element's size in device pixels, and the pixel ratio. */
export function deviceSizeOf(element: Element): [width: number, height: number, ratio: number] {
  const { width, height } = element.getBoundingClientRect();
  return [devicePixels(width, undefined), devicePixels(height, undefined), devicePixelRatio];
}

/**
 * The exact size that the browser reports; if it differs by more than rounding, the rounded size: the browser's report
 * does not include an emulated pixel ratio.
 */
function devicePixels(cssPixels: number, exact: number | undefined): number {
  const product = cssPixels * devicePixelRatio;
  return exact !== undefined && Math.abs(exact - product) <= 1 ? exact : Math.round(product);
}
