// Records what a page displays in each frame, so that tests find pictures that last for one frame only.

import type { View } from "./harness.ts";

/** `before` of such a page: in the page, before its scripts: keeps what a canvas displays readable after the frame. */
export function recordFrames(): void {
  type GetContext = (this: HTMLCanvasElement, type: string, options?: object) => unknown;
  const getContext = Reflect.get(HTMLCanvasElement.prototype, "getContext") as GetContext;
  const getKeptContext: GetContext = function (type, options) {
    if (type === "webgl2") Object.assign(window, { sceneCanvas: this });
    return getContext.call(this, type, { ...options, preserveDrawingBuffer: true });
  };
  Object.assign(HTMLCanvasElement.prototype, { getContext: getKeptContext });
}

/** From now on counts, in each frame of a page with `recordFrames`, the pixels that differ from the background. */
export async function startRecording(view: View): Promise<void> {
  await view.page.evaluate(() => {
    const { sceneCanvas } = window as unknown as { sceneCanvas: HTMLCanvasElement };
    const [width, height] = [64, 48];
    const small = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true })!;
    const coverages: number[] = [];
    Object.assign(window, { coverages });
    const record = (): void => {
      small.clearRect(0, 0, width, height);
      small.drawImage(sceneCanvas, 0, 0, width, height);
      const { data } = small.getImageData(0, 0, width, height);
      let count = 0;
      for (let at = 0; at < data.length; at += 4)
        if ([0, 1, 2, 3].some((channel) => Math.abs(data[at + channel]! - data[channel]!) > 8)) count += 1;
      coverages.push(count);
      requestAnimationFrame(record);
    };
    record();
  });
}

/** The counts since `startRecording`, a number for each frame. */
export async function coveragesOf({ page }: View): Promise<number[]> {
  return page.evaluate(() => (window as unknown as { coverages: number[] }).coverages);
}
