// Composes all pictures of a run into one.

import type { Browser } from "playwright-core";
import type { Runtime } from "./runtimes.ts";
import { runtimes, size } from "./runtimes.ts";

export interface Row {
  readonly name: string;
  readonly pictures: Readonly<Record<Runtime, Buffer>>;
}

const scale = 0.4;
const columns = 4;

/** A PNG with four documents in a row, each with the pictures of all runtimes. */
export async function contactSheet(browser: Browser, rows: readonly Row[]): Promise<Buffer> {
  const [width, height] = [size.width * scale, size.height * scale];
  const cells = rows.map(
    ({ name, pictures }) =>
      `<figure>${runtimes
        .map(
          (runtime) =>
            `<img width="${width}" height="${height}" src="data:image/png;base64,${pictures[runtime].toString("base64")}">`,
        )
        .join("")}<figcaption>${name}</figcaption></figure>`,
  );
  const page = await browser.newPage({ viewport: { width: columns * (3 * width + 12), height: 600 } });
  await page.setContent(`<style>
    body { margin: 0; display: grid; grid-template-columns: repeat(${columns}, auto); font: 11px/16px sans-serif; background: #fff; color: #333 }
    figure { margin: 2px 4px; white-space: nowrap; line-height: 0 } img + img { margin-left: 2px } figcaption { line-height: 16px }
  </style>${cells.join("")}`);
  const png = await page.screenshot({ fullPage: true });
  await page.close();
  return png;
}
