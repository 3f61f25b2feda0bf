// Bytes and seconds until a viewpoint is displayed to an error of a pixel, of a page of imgeo and of 3d-tiles-renderer with
// the same levels; and the first image of a large mesh beside that of the dragon.

import { writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Request } from "playwright-core";
import type { LinkOptions } from "../../tests/browser/networkLink.ts";
import type { TestServer } from "../../tests/browser/server.ts";
import { timesOf, type Times } from "../load/frameRecorder.ts";
import { load, medianLoad, openTab, serve, viewport } from "../load/measure.ts";
import type { BenchPage } from "../load/pages.ts";
import { rivalPage } from "./rivalPage.ts";
import { sitePage, variantOf, viewpoints, withCamera, type Camera } from "./sites.ts";

export const line: LinkOptions = { bitsPerSecond: 20e6, roundTripMs: 40 };
/** The background of all pages: 0.93, 0.94, 0.95. */
const background = [237, 240, 242];

interface Load extends Times {
  bytes: number;
  /** Tiles or groups, and the tileset or the index. */
  geometryBytes: number;
  files: number;
}

const isGeometry = (path: string): boolean => /\/geometry\/|\.glb$|\/tileset\.json$/.test(path);

async function loadOnce(browser: Browser, page: BenchPage, server: TestServer, picture?: string): Promise<Load> {
  const context = await browser.newContext({ viewport });
  try {
    const tab = await openTab(context, page, true);
    const finished: Request[] = [];
    tab.on("requestfinished", (request) => finished.push(request));
    const before = server.bytesSent;
    await load(tab, page, server);
    await tab.waitForTimeout(300); // a last frame may follow
    const times = await tab.evaluate(timesOf, background);
    if (picture !== undefined) writeFileSync(picture, await tab.screenshot());
    const bytes = server.bytesSent - before;
    const geometry = finished.filter((request) => isGeometry(new URL(request.url()).pathname));
    const sizes = await Promise.all(geometry.map(async (request) => (await request.sizes()).responseBodySize));
    return { ...times, bytes, geometryBytes: sizes.reduce((sum, size) => sum + size, 0), files: geometry.length };
  } finally {
    await context.close();
  }
}

/** Medians of the pages' loads, which take turns. `pictures`: folder of a picture of each, or undefined. */
async function medianLoads(
  browser: Browser,
  pages: readonly BenchPage[],
  runs: number,
  pictures: string | undefined,
): Promise<Load[]> {
  const servers = await Promise.all(pages.map(serve));
  const loads = pages.map((): Load[] => []);
  try {
    for (let run = 0; run < runs; ++run)
      for (const [i, page] of pages.entries()) {
        const server = servers[i]!;
        server.useLink(line);
        const picture = run === 0 && pictures !== undefined ? join(pictures, `${page.name}.png`) : undefined;
        loads[i]!.push(await loadOnce(browser, page, server, picture));
      }
  } finally {
    await Promise.all(servers.map((server) => server.close()));
  }
  return loads.map((own) => {
    const median = (of: keyof Load): number =>
      own.map((each) => each[of]).sort((a, b) => a - b)[Math.floor(own.length / 2)]!;
    return {
      first: median("first"),
      nearlyFinal: median("nearlyFinal"),
      final: median("final"),
      bytes: median("bytes"),
      geometryBytes: median("geometryBytes"),
      files: median("files"),
    };
  });
}

export interface ViewOptions {
  site: string;
  /** Folder of the same levels as a tileset; undefined: the site's page alone. */
  tileset: string | undefined;
  work: string;
  runs: number;
  pictures: string | undefined;
  /** Keys of `viewpoints`. */
  names: readonly string[];
}

export async function printViews(browser: Browser, options: ViewOptions): Promise<void> {
  console.log(
    "| viewpoint | page | geometry: files | kB | all: kB | first / 90 % / final image, s | bytes, of theirs | of all | final image, of theirs |",
  );
  console.log("|---|---|--:|--:|--:|--:|--:|--:|--:|");
  for (const name of options.names) {
    const camera = viewpoints[name];
    if (camera === undefined)
      throw new Error(`no viewpoint "${name}"; there are ${Object.keys(viewpoints).join(", ")}`);
    const pages = await pagesOf(name, camera, options);
    const [own, ...others] = await medianLoads(browser, pages, options.runs, options.pictures);
    for (const [i, each] of [own!, ...others].entries()) {
      const seconds = [each.first, each.nearlyFinal, each.final].map((ms) => (ms / 1000).toFixed(2)).join(" / ");
      const ratios = (["geometryBytes", "bytes", "final"] as const).map((of) =>
        i === 0 ? "" : (own![of] / each[of]).toFixed(2),
      );
      const kilobytes = [each.geometryBytes, each.bytes].map((bytes) => Math.round(bytes / 1000));
      console.log(
        `| ${[name, pages[i]!.name.split(", ")[1], each.files, ...kilobytes, seconds, ...ratios].join(" | ")} |`,
      );
    }
  }
}

async function pagesOf(name: string, camera: Camera, { site, tileset, work }: ViewOptions): Promise<BenchPage[]> {
  const key = name.replaceAll(" ", "-");
  const variant = variantOf(site, key, (page) => withCamera(page, camera));
  const pages = [sitePage(`${name}, imgeo`, variant)];
  if (tileset === undefined) return pages;
  for (const [title, loadsAll] of [
    ["3d-tiles-renderer", true],
    ["3d-tiles-renderer without siblings and ancestors", false],
  ] as const)
    pages.push(
      await rivalPage(`${name}, ${title}`, tileset, join(work, `tiles-${key}-${String(loadsAll)}`), camera, loadsAll),
    );
  return pages;
}

/** The first image of the site beside the dragon's, which is smaller than what has no levels. */
export async function printFirstImages(browser: Browser, site: string, dragon: string, runs: number): Promise<void> {
  console.log("| page | first image, s | of the dragon's |");
  console.log("|---|--:|--:|");
  const times: number[] = [];
  for (const page of [sitePage("dragon", dragon), sitePage("relief", site)]) {
    const server = await serve(page);
    times.push((await medianLoad(browser, page, server, line, runs)).first / 1000);
    await server.close();
    console.log(`| ${page.name} | ${times.at(-1)!.toFixed(2)} | ${(times.at(-1)! / times[0]!).toFixed(2)} |`);
  }
}
