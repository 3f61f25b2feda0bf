// User input for tests: keyboard focus, touch and mouse; and a measure of how much of the picture is covered.

import assert from "node:assert/strict";
import { pictureSize, type View } from "./harness.ts";
import type { Picture } from "./png.ts";

/** Center of a page of the default size, in CSS pixels. */
export const center = { x: pictureSize.width / 2, y: pictureSize.height / 2 };

/** Moves the keyboard focus to the view. */
export async function focusView({ page }: View): Promise<void> {
  await page.keyboard.press("Tab");
  const focused = await page.evaluate(() => document.activeElement?.localName);
  assert.equal(focused, "imgeo-view");
}

/** Touches the view: one list of finger positions, relative to the center, for each moment. */
export async function touch({ page }: View, moments: [number, number][][]): Promise<void> {
  const session = await page.context().newCDPSession(page);
  const points = (fingers: [number, number][]): { x: number; y: number; id: number }[] =>
    fingers.map(([x, y], id) => ({ x: center.x + x, y: center.y + y, id }));
  for (const [moment, fingers] of moments.entries()) {
    const type = moment === 0 ? "touchStart" : "touchMove";
    await session.send("Input.dispatchTouchEvent", { type, touchPoints: points(fingers) });
  }
  await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
}

/** Drags with the mouse from the center. */
export async function drag({ page }: View, right: number, down: number): Promise<void> {
  await page.mouse.move(center.x, center.y);
  await page.mouse.down();
  await page.mouse.move(center.x + right, center.y + down, { steps: 5 });
  await page.mouse.up();
}

/** Number of pixels that differ from the top left pixel by more than 8 in a channel. */
export function coveredPixelCount({ data, channels }: Picture): number {
  let count = 0;
  for (let at = 0; at < data.length; at += channels) {
    count += [0, 1, 2].some((channel) => Math.abs(data[at + channel]! - data[channel]!) > 8) ? 1 : 0;
  }
  return count;
}
