// Pages with levels of detail, for tests: seen from a viewpoint, before a backdrop that shows through holes, with what
// they have requested and have on the GPU.

import type { ViewStatistics } from "../../web/src/dom/pageViewer.ts";
import { holesIn, silhouette } from "./compare.ts";
import type { View } from "./harness.ts";
import type { Picture } from "./png.ts";

/** The page with another viewpoint. */
export function seenFrom(page: string, position: string, orientation: string): string {
  return page
    .replace(/(<Viewpoint[^>]*?position=")[^"]*/, `$1${position}`)
    .replace(/(<Viewpoint[^>]*?orientation=")[^"]*/, `$1${orientation}`);
}

/** The page with a backdrop of a colour that no surface has. */
export function onMagenta(page: string): string {
  return page.replace(/skyColor="[^"]*"/, 'skyColor="1 0 1"');
}

/** Pixels of a magenta backdrop inside of the silhouette. */
export function magentaInside(picture: Picture): number {
  const data = new Uint8Array(picture.data.length);
  for (let i = 0; i < data.length; i += picture.channels) data.set([255, 0, 255].slice(0, picture.channels), i);
  return holesIn(silhouette(picture, { ...picture, data }), picture.width);
}

/** The files of groups that a page has requested. */
export function groupFilesOf({ requestedPaths }: View): string[] {
  return requestedPaths.filter((path) => /^geometry\/[0-9a-f]{16}\/\d+\/\d+\.png$/.test(path));
}

export function statisticsOf({ page }: View): Promise<ViewStatistics> {
  return page.evaluate(() => (document.querySelector("x3d") as unknown as { statistics: ViewStatistics }).statistics);
}
