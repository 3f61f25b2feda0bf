// Measures what a frame of a scene that moves costs on the page's main thread: 1,000 Transforms by one TimeSensor,
// 1,000 interpolators and 2,000 ROUTEs, beside a script that writes the same attributes and beside as many meshes that
// an AnimationMixer of three.js moves; and a grid of 10,000 points by a CoordinateInterpolator. Prints a Markdown
// table of the first frames, and of those of a page that has played for long: the processor time that the thread's
// scripts take for a whole frame with its drawing, mean of many, and the median and the minimum of the durations
// before it is drawn, which other processes lengthen. All of them are medians of three browsers, since some stay
// slower than others for as long as they run. Then plays 10,000 frames of two scenes and of a sequence, a recorded
// cloth, and prints the memory before and after; and the time that a page takes to display frames of that cloth, from
// its files of frames and from its lossless video.
//
//   scripts/bench motion            FRAMES=3000: plays fewer frames

import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { build } from "esbuild";
import type { Browser, Page } from "playwright-core";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { startServer } from "../../tests/browser/server.ts";
import { changeTimes } from "../changeTimes.ts";
import { goUntilComplete } from "../completePage.ts";

const count = 1000;
const rounds = 100;
/** Browsers that are started for each row. */
const browsers = 3;
/** Frames after which Chromium has compiled everything with its slowest compiler: it counts calls, here a million. */
const steadyAfter = 1000;
const frameCount = Number(process.env.FRAMES ?? 10_000);
const timeout = 120_000;

type Kind = "PositionInterpolator" | "OrientationInterpolator";

/** The columns of one measurement of `timesOf`. */
const columns = "processor time | before drawing, median | minimum";

const appearance = '<Appearance><Material diffuseColor="0.5 0.5 0.5"></Material></Appearance>';

/** `count` Transforms, each with a shape of its own or with one that all share. */
function sceneText(kind: Kind, isShared: boolean): string {
  const shapes = Array.from({ length: count }, (_, n) => {
    const [x, y] = [2 * (n % 40), 2 * Math.floor(n / 40)];
    const shape =
      isShared && n > 0
        ? '<Shape USE="box"></Shape>'
        : `<Shape${n === 0 ? ' DEF="box"' : ""}>${appearance}<Box size="1 1 ${1 + n / 10000}"></Box></Shape>`;
    const values =
      kind === "PositionInterpolator"
        ? `${x} ${y} 0  ${x} ${y} ${1 + (n % 3)}  ${x} ${y} 0`
        : `0 1 0 0  0 1 0 ${1 + (n % 3)}  0 1 0 0`;
    const [field, still] =
      kind === "PositionInterpolator" ? ["translation", ""] : ["rotation", ` translation="${x} ${y} 0"`];
    return `<Transform DEF="t${n}"${still}>${shape}</Transform>
<${kind} DEF="i${n}" key="0 0.5 1" keyValue="${values}"></${kind}>
<ROUTE fromNode="clock" fromField="fraction_changed" toNode="i${n}" toField="set_fraction"></ROUTE>
<ROUTE fromNode="i${n}" fromField="value_changed" toNode="t${n}" toField="${field}"></ROUTE>`;
  });
  return `<X3D style="width:64px;height:48px;display:block" paused><Scene><Viewpoint position="40 25 90"></Viewpoint>
<TimeSensor DEF="clock"></TimeSensor>${shapes.join("\n")}</Scene></X3D>`;
}

const gridEdge = 100;

/** A grid of gridEdge² points, which a wave moves. */
function gridText(): string {
  const indices = Array.from({ length: gridEdge * gridEdge }, (_, n) => n);
  const points = (phase: number) =>
    indices
      .map((n) => {
        const [x, y] = [n % gridEdge, Math.floor(n / gridEdge)];
        return `${x} ${y} ${(3 * Math.sin(x / 9 + phase)).toFixed(2)}`;
      })
      .join(" ");
  const faces = indices
    .filter((n) => n % gridEdge < gridEdge - 1 && n < gridEdge * (gridEdge - 1))
    .map((n) => `${n} ${n + 1} ${n + gridEdge + 1} ${n + gridEdge} -1`);
  return `<X3D style="width:64px;height:48px;display:block" paused><Scene><Viewpoint position="50 50 150"></Viewpoint>
<TimeSensor DEF="clock"></TimeSensor><Shape>${appearance}<IndexedFaceSet creaseAngle="3.2" coordIndex="${faces.join(" ")}">
<Coordinate DEF="points" point="${points(0)}"></Coordinate></IndexedFaceSet></Shape>
<CoordinateInterpolator DEF="wave" key="0 0.5 1" keyValue="${[0, 1, 2].map(points).join(" ")}"></CoordinateInterpolator>
<ROUTE fromNode="clock" fromField="fraction_changed" toNode="wave" toField="set_fraction"></ROUTE>
<ROUTE fromNode="wave" fromField="value_changed" toNode="points" toField="set_point"></ROUTE></Scene></X3D>`;
}

/** A folder with a page of three.js (threeScene.ts), whose meshes move by this field. */
async function writeThreePage(folder: string, field: "position" | "quaternion"): Promise<void> {
  await build({
    entryPoints: ["bench/motion/threeScene.ts"],
    outfile: join(folder, "page.js"),
    bundle: true,
    format: "esm",
    minify: true,
    logLevel: "warning",
  });
  writeFileSync(
    join(folder, "index.html"),
    `<!DOCTYPE html><title>motion</title><body data-count="${count}" data-field="${field}">
<canvas width="64" height="48"></canvas><script type="module" src="page.js"></script>`,
  );
}

const routes = "ROUTEs from one TimeSensor";

/** Self-contained functions that the page calls repeatedly. */
const frames: Record<string, (round: number) => void> = {
  [routes]: (round) => {
    document.querySelector("timesensor")!.setAttribute("set_fraction", String((round % 97) / 97));
  },
  "a script that writes 1,000 attributes": (round) => {
    document.querySelectorAll("transform").forEach((transform, n) => {
      transform.setAttribute("translation", `${2 * (n % 40)} ${2 * Math.floor(n / 40)} ${(round % 97) / 97}`);
    });
  },
};
const showFraction = (round: number): void => {
  globalThis.showFraction((round % 97) / 97);
};

/** Bytes after everything that is no longer used has been freed. */
async function memoryOf(page: Page): Promise<{ heap: number; gpu: number }> {
  const session = await page.context().newCDPSession(page);
  await session.send("HeapProfiler.collectGarbage");
  const { usedSize } = await session.send("Runtime.getHeapUsage");
  const gpu = await page.evaluate(() => {
    const { statistics } = document.querySelector("x3d") as unknown as {
      statistics: { bufferBytes: number; textureBytes: number };
    };
    return statistics.bufferBytes + statistics.textureBytes;
  });
  return { heap: usedSize, gpu };
}

/** The memory after 100 frames and after `frameCount`, which `play` displays. */
async function memoryRow(page: Page, name: string, play: (count: number) => Promise<unknown>): Promise<string> {
  await play(100);
  const before = await memoryOf(page);
  await play(frameCount - 100);
  const after = await memoryOf(page);
  const megabytes = (bytes: number): string => `${(bytes / 1e6).toFixed(2)} MB`;
  const cells = [before.heap, after.heap, before.gpu, after.gpu].map(megabytes);
  return `| ${name} | ${cells.join(" | ")} |`;
}

const recordedFrames = 90;

/** Converts a cloth of 64 x 64 vertices, three seconds, to frames and to a video, in folders of their own. */
function convertCloth(folder: string): void {
  const imgeo = (...words: string[]): void =>
    void execFileSync("build/imgeo", words, { stdio: ["ignore", "ignore", "inherit"] });
  const files = join(folder, "frames");
  imgeo("sample", "cloth", "--frames", String(recordedFrames), "--grid", "64", "-o", files);
  imgeo("convert", join(files, "cloth-*.ply"), "-o", join(folder, "cloth"), "--no-pictures");
  imgeo("convert", join(files, "cloth-*.ply"), "-o", join(folder, "video"), "--no-pictures", "--as", "video");
}

/** Milliseconds from asking for a frame until it is displayed, for each of these frames, one after the other. */
function frameTimes(page: Page, numbers: readonly number[]): Promise<number[]> {
  return page.evaluate(async (frames) => {
    const x3d = document.querySelector("x3d")!;
    const times: number[] = [];
    for (const number of frames) {
      const displayed = new Promise((resolve) => {
        x3d.addEventListener("frame", resolve, { once: true, capture: true });
      });
      const begun = performance.now();
      x3d.setAttribute("sequence-time", String((number + 0.5) / 30));
      await displayed;
      times.push(performance.now() - begun);
    }
    return times;
  }, numbers);
}

/** Frames in their order, and frames in the middle between key frames, forwards and backwards. */
async function frameTimeRow(page: Page, name: string): Promise<string> {
  const forwards = Array.from({ length: recordedFrames - 1 }, (_, n) => n + 1);
  const seeks = Array.from({ length: 40 }, (_, n) => ((n * 37) % 3) * 30 + 15 + (n % 2));
  await frameTimes(page, forwards); // all files have been fetched, and the code compiled
  const cells: string[] = [];
  for (const numbers of [forwards, seeks]) {
    const times = await frameTimes(page, numbers);
    for (const time of [middleOf(times), Math.min(...times)]) cells.push(`${time.toFixed(1)} ms`);
  }
  return `| ${name} | ${cells.join(" | ")} |`;
}

/** Displays the frames of the page's sequence, one after the other, from the first again behind the last. */
function playSequence(page: Page, count: number): Promise<void> {
  return page.evaluate(
    async ({ total, length }) => {
      const x3d = document.querySelector("x3d")!;
      for (let played = 1; played <= total; ++played) {
        const displayed = new Promise((resolve) => {
          x3d.addEventListener("frame", resolve, { once: true, capture: true });
        });
        x3d.setAttribute("sequence-time", String((played % length) / 30));
        await displayed;
      }
    },
    { total: count, length: recordedFrames },
  );
}

const middleOf = (times: readonly number[]): number =>
  times.toSorted((a, b) => a - b)[Math.floor(times.length / 2)] ?? NaN;

/** `isSteady`: also measures frames of a page that has played for long. In milliseconds. */
async function timesOf(page: Page, change: (round: number) => void, isSteady: boolean): Promise<number[]> {
  const run = (count: number, pause = 20): Promise<number[]> => changeTimes(page, change, count, pause);
  await run(rounds / 4); // until the code has been compiled for the first time
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const scriptSeconds = async (): Promise<number> => {
    const { metrics } = await session.send("Performance.getMetrics");
    return metrics.find((metric) => metric.name === "ScriptDuration")?.value ?? NaN;
  };
  const times: number[] = [];
  const measure = async (): Promise<void> => {
    const before = await scriptSeconds();
    const durations = await run(rounds);
    const processor = (1000 * ((await scriptSeconds()) - before)) / rounds;
    times.push(processor, middleOf(durations), Math.min(...durations));
  };
  await measure();
  if (isSteady) {
    await run(steadyAfter, 0);
    await measure();
  }
  return times;
}

/** Measures in a browser after the other; `measure` opens the page. */
async function row(name: string, isSteady: boolean, measure: (browser: Browser) => Promise<number[]>): Promise<string> {
  const all: number[][] = [];
  for (let started = 0; started < browsers; ++started) {
    const browser = await launchChromium();
    try {
      all.push(await measure(browser));
    } finally {
      await browser.close();
    }
  }
  const cells = all[0]!.map((_, column) => `${middleOf(all.map((times) => times[column]!)).toFixed(2)} ms`);
  return `| ${name} | ${cells.join(" | ")} |${isSteady ? "" : " – | – | – |"}`;
}

/** The page of a scene, when it is complete. `address`: of its folder. */
async function playingPage(browser: Browser, address: string): Promise<Page> {
  const page = await browser.newPage({ viewport: { width: 160, height: 120 } }); // less for the browser to compose
  await goUntilComplete(page, address, timeout);
  await page.waitForFunction(() => "getFieldValue" in document.querySelector("timesensor")!);
  return page;
}

const directory = mkdtempSync(join(tmpdir(), "imgeo-motion-"));
for (const name of readdirSync("web/dist")) cpSync(join("web/dist", name), join(directory, name));
const scenes: Record<string, string> = {
  "positions, own shapes": sceneText("PositionInterpolator", false),
  "positions, one shape": sceneText("PositionInterpolator", true),
  "rotations, own shapes": sceneText("OrientationInterpolator", false),
  "a grid of 10,000 points": gridText(),
};
const memoryScenes = ["positions, own shapes", "a grid of 10,000 points"];
const server = await startServer(directory);
const browser = await launchChromium();
try {
  const memory: string[] = [];
  console.log(
    `| ${count} moving Transforms | ${columns} | after ${steadyAfter} frames: ${columns} |\n|---${"|--:".repeat(6)}|`,
  );
  for (const [scene, text] of Object.entries(scenes)) {
    writeFileSync(
      join(directory, "index.html"),
      `<!DOCTYPE html><title>motion</title><script type="module" src="imgeo.js"></script>${text}`,
    );
    for (const [name, change] of Object.entries(frames))
      if (name === routes || text.includes("<Transform"))
        console.log(
          await row(`${scene}: ${name}`, name === routes, async (each) =>
            timesOf(await playingPage(each, server.origin), change, name === routes),
          ),
        );
    if (memoryScenes.includes(scene)) {
      const page = await playingPage(browser, server.origin);
      memory.push(await memoryRow(page, scene, (played) => changeTimes(page, frames[routes]!, played, 1)));
      await page.close();
    }
  }
  for (const [motion, field] of [
    ["positions", "position"],
    ["rotations", "quaternion"],
  ] as const) {
    const folder = join(directory, field);
    mkdirSync(folder);
    await writeThreePage(folder, field);
    console.log(
      await row(`${motion}, own shapes: three.js, one AnimationMixer`, true, async (each) => {
        const page = await each.newPage({ viewport: { width: 160, height: 120 } });
        await page.goto(`${server.origin}${field}/`);
        await page.waitForFunction(() => "showFraction" in globalThis);
        return timesOf(page, showFraction, true);
      }),
    );
  }
  convertCloth(directory);
  const page = await browser.newPage({ viewport: { width: 320, height: 240 } });
  await goUntilComplete(page, `${server.origin}cloth/`, timeout);
  memory.push(await memoryRow(page, "a sequence of 4,096 vertices", (played) => playSequence(page, played)));
  await page.close();
  console.log(
    "\n| a cloth of 4,096 vertices | next frame, median | minimum | seek, median | minimum |\n|---|--:|--:|--:|--:|",
  );
  for (const [folder, name] of Object.entries({ cloth: "files of frames", video: "lossless video" })) {
    const player = await browser.newPage({ viewport: { width: 320, height: 240 } });
    await goUntilComplete(player, `${server.origin}${folder}/`, timeout);
    console.log(await frameTimeRow(player, name));
    await player.close();
  }
  console.log(`\n| ${frameCount} frames | heap after 100 | heap after all | GPU after 100 | GPU after all |`);
  console.log(`|---|--:|--:|--:|--:|\n${memory.join("\n")}`);
} finally {
  await browser.close();
  await server.close();
  rmSync(directory, { recursive: true });
}
