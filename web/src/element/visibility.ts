/** Calls back once, as soon as the element comes nearer to the visible part of the page than `margin` screens. At once where it is. */
export function whenNear(element: Element, margin: number, signal: AbortSignal, onNear: () => void): void {
  if (isNear(element.getBoundingClientRect(), margin)) {
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

/** Whether any of it is less than `margin` screens away from the visible part of the page. */
export function isNear({ left, right, top, bottom, width, height }: DOMRect, margin: number): boolean {
  return (
    width > 0 &&
    height > 0 &&
    right >= -margin * innerWidth &&
    left <= (1 + margin) * innerWidth &&
    bottom >= -margin * innerHeight &&
    top <= (1 + margin) * innerHeight
  );
}

/** Tells the element's size in device pixels, now and whenever it or the pixel ratio changes. */
export function watchSize(
  element: Element,
  signal: AbortSignal,
  onSize: (width: number, height: number, ratio: number) => void,
): void {
  const observer = new ResizeObserver((entries) => {
    for (const { contentRect, devicePixelContentBoxSize } of entries) {
      // Not every browser tells device pixels.
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

/** The same, asked for. */
export function sizeOf(element: Element): [width: number, height: number, ratio: number] {
  const { width, height } = element.getBoundingClientRect();
  return [devicePixels(width, undefined), devicePixels(height, undefined), devicePixelRatio];
}

/** What the browser says it is, unless that is more than a rounding away: an emulated pixel ratio is not in it. */
function devicePixels(cssPixels: number, exact: number | undefined): number {
  const product = cssPixels * devicePixelRatio;
  return exact !== undefined && Math.abs(exact - product) <= 1 ? exact : Math.round(product);
}
