// Tests what follows shapes that move: what is at a pixel, wide lines and points, and, in three.js apps, shadows. What
// moves is compared with pages and apps whose shapes stand still at that position, or are recorded frames of it.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import type { ImgeoView } from "../../web/src/dom/index.ts";
import { breath, breathSite, rate } from "./breath.ts";
import { bundleApp } from "./appBundles.ts";
import { serveApp } from "./appPage.ts";
import { assertSamePicture, difference, savePicture, type Bounds } from "./compare.ts";
import { screenshotOf, settle, until, withPage, type View } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import type { Picture } from "./png.ts";
import { writeRiggedScene } from "./riggedScene.ts";
import { route, sceneOf, shapeInFolder } from "./scenes.ts";
import { pageOf, siteOf, siteOfFrames, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

const size = { width: 320, height: 240 };

const camera = `<NavigationInfo transitionType="TELEPORT"></NavigationInfo>
  <Viewpoint position="0 4 9" orientation="-1 0 0 0.4"></Viewpoint>`;
const material = '<Appearance><Material diffuseColor="0.8 0.7 0.5"></Material></Appearance>';
const floor = `<Transform translation="0 -1.6 0"><Shape>${material}<Box size="12 0.1 12"></Box></Shape></Transform>`;

/** What is at each point of a grid over the view: where in the scene, or nothing. */
const hitsOf = ({ page }: View): Promise<(readonly number[] | undefined)[]> =>
  page.evaluate(() => {
    const view = document.querySelector<ImgeoView>("imgeo-view")!;
    return Array.from({ length: 8 * 6 }, (_, n) => {
      const [x, y] = [((n % 8) + 0.5) / 8, (Math.floor(n / 8) + 0.5) / 6];
      const hit = view.positionAndNormalFromPoint(x * innerWidth, y * innerHeight);
      return hit ? [hit.position.x, hit.position.y, hit.position.z] : undefined;
    });
  });

interface Seen {
  readonly picture: Picture;
  readonly hits: (readonly number[] | undefined)[];
}

async function seenIn(view: View): Promise<Seen> {
  return { picture: await view.picture(), hits: await hitsOf(view) };
}

/** What a page shows, after `prepare`, when everything has been drawn. */
async function seenOf(site: string, prepare?: (view: View) => Promise<void>): Promise<Seen> {
  let seen: Seen | undefined;
  await withPage(site, { size }, async (view) => {
    await view.promise("complete");
    await prepare?.(view);
    seen = await seenIn(view);
  });
  assert.ok(seen);
  return seen;
}

/** Pictures within the bounds, and the same points hit, except at a few silhouettes. */
function assertSeenAlike(name: string, actual: Seen, expected: Seen, bounds: Bounds, tolerance: number): void {
  savePicture(name, actual.picture);
  assertSamePicture(name, actual.picture, expected.picture, bounds);
  const off = actual.hits.flatMap((hit, n) => {
    const other = expected.hits[n];
    if (hit === undefined || other === undefined) return hit === other ? [] : [n];
    return Math.hypot(...hit.map((value, axis) => value - other[axis]!)) > tolerance ? [n] : [];
  });
  const pairs = off.map((n) => `${n}: ${actual.hits[n]?.join(" ")} is not ${expected.hits[n]?.join(" ")}`);
  assert.ok(off.length <= 1, `${name}: of ${actual.hits.length} points\n${pairs.join("\n")}`);
}

async function setAttribute({ page }: View, selector: string, name: string, value: string): Promise<void> {
  await page.evaluate(
    ([select, attribute, text]) => {
      document.querySelector(select)!.setAttribute(attribute, text);
    },
    [selector, name, value] as const,
  );
}

/** Sets the clock's fraction when the page can play, and waits until the attributes have followed. */
async function scrub(view: View, fraction: number): Promise<void> {
  await until("the animation is loaded", () =>
    view.page.evaluate(() => "getFieldValue" in document.querySelector("timesensor")!),
  );
  await setAttribute(view, "timesensor", "set_fraction", String(fraction));
  await settle(view.page);
  await view.page.waitForTimeout(300);
}

/** The page with its scene as its elements say, without the clock. */
async function standing(view: View, site: string): Promise<Seen> {
  const text = await view.page.evaluate(() => {
    const copy = document.querySelector("x3d")!.cloneNode(true) as Element;
    for (const element of Array.from(copy.querySelectorAll("imgeo-view, timesensor, route"))) element.remove();
    return copy.outerHTML;
  });
  const html = pageOf(site).replace(/<X3D[\s\S]*<\/X3D>/i, () => text);
  let seen: Seen | undefined;
  const server = (of: View["server"]): void => void of.when(/^\/$/, { replace: () => html });
  await withPage(site, { size, server }, async (fresh) => {
    await fresh.promise("complete");
    seen = await seenIn(fresh);
  });
  assert.ok(seen);
  return seen;
}

const points = (turn: number): string =>
  Array.from({ length: 12 }, (_, n) =>
    [(n - 5.5) * 0.5, 1 + 0.8 * Math.sin(n + turn), 0.5 * Math.cos(2 * n + turn)].map((x) => x.toFixed(3)).join(" "),
  ).join(" ");
const lineIndex = `${Array.from({ length: 12 }, (_, n) => n).join(" ")} -1`;
const wideLines = `<Shape><Appearance><Material emissiveColor="1 0.5 0"></Material><LineProperties linewidthScaleFactor="6"></LineProperties></Appearance>
  <IndexedLineSet coordIndex="${lineIndex}"><Coordinate DEF="line" point="${points(0)}"></Coordinate></IndexedLineSet></Shape>`;
const wideDots = `<Shape><Appearance><Material emissiveColor="0 0.8 1"></Material><PointProperties pointSizeScaleFactor="14"></PointProperties></Appearance>
  <PointSet><Coordinate DEF="dots" point="${points(2)}"></Coordinate></PointSet></Shape>`;

const movingScene = `${camera}${floor}
  <TimeSensor DEF="clock" cycleInterval="2" loop="true"></TimeSensor>
  <PositionInterpolator DEF="way" key="0 1" keyValue="-4 0.5 0  4 0.5 1"></PositionInterpolator>
  <OrientationInterpolator DEF="turn" key="0 1" keyValue="0 0 1 0  0 0 1 2.5"></OrientationInterpolator>
  <CoordinateInterpolator DEF="lift" key="0 1" keyValue="-2 -1 2 0 -1 2 -1 1 2  0 -1 2 3 -1 2 1 0.5 3"></CoordinateInterpolator>
  <CoordinateInterpolator DEF="swing" key="0 1" keyValue="${points(0)} ${points(3)}"></CoordinateInterpolator>
  <CoordinateInterpolator DEF="dance" key="0 1" keyValue="${points(2)} ${points(5)}"></CoordinateInterpolator>
  <Transform DEF="outer"><Transform DEF="inner"><Shape>${material}<Box size="1.5 0.6 1"></Box></Shape></Transform></Transform>
  <Shape>${material}<IndexedFaceSet solid="false" coordIndex="0 1 2 -1"><Coordinate DEF="leaf" point="-2 -1 2 0 -1 2 -1 1 2"></Coordinate></IndexedFaceSet></Shape>
  <Transform translation="-0.4 1.4 -2">${wideLines}</Transform><Transform translation="0.4 1 -2">${wideDots}</Transform>
  ${["way", "turn", "lift", "swing", "dance"].map((name) => route("clock.fraction_changed", `${name}.set_fraction`)).join("")}
  ${route("way.value_changed", "outer.translation")}${route("turn.value_changed", "inner.rotation")}
  ${route("lift.value_changed", "leaf.point")}${route("swing.value_changed", "line.point")}${route("dance.value_changed", "dots.point")}`;

test("what moves, wide lines and points among it, is drawn and hit as where it stands", async () => {
  const site = sceneOf("moving", { trefoil: siteOfGenerated("trefoil") }, movingScene);
  await withPage(site, { size }, async (view) => {
    await view.promise("complete");
    const rest = await seenIn(view);
    await scrub(view, 0.7);
    const moved = await seenIn(view);
    assert.ok(difference(moved.picture, rest.picture).offShare > 0.05, "it moves");
    assertSeenAlike("moving", moved, await standing(view, site), { mean: 0.05, offShare: 0.001 }, 1e-3);
  });
});

/** A page of the breathing sphere's site, or of a single frame of it. */
const breathPage = (name: string, site: string, attributes = ""): string =>
  sceneOf(name, { ball: site }, `${camera}${floor}${shapeInFolder(site, "ball")}`, attributes);

const stillBreath = (frame: number): string =>
  siteOfFrames(`breath-still-${frame}`, [breath[frame]!], "--profile", "classic");

soakTest("a sequence is hit where its frame is", async () => {
  const frame = 14;
  await withPage(breathPage("moving-sequence", breathSite(), 'sequence-time="0"'), { size }, async (view) => {
    await view.promise("complete");
    const rest = await seenIn(view);
    await setAttribute(view, "x3d", "sequence-time", String(frame / rate));
    await settle(view.page);
    await view.page.waitForTimeout(300);
    const moved = await seenIn(view);
    assert.ok(difference(moved.picture, rest.picture).offShare > 0.01, "it moves");
    const still = await seenOf(breathPage("moving-sequence-stood", stillBreath(frame)));
    // The single frame has loaded the first byte of its coordinates only, whose steps are smaller than a pixel.
    assertSeenAlike("moving-sequence", moved, still, { mean: 0.1, offShare: 0.002 }, 2e-2);
  });
});

const riggedSite = (...options: string[]): string =>
  siteOf(writeRiggedScene(), "--profile", "classic", "--normal-bits", "16", ...options);

soakTest("skins and morph targets are hit where recorded frames of them are", async () => {
  await withPage(riggedSite(), { size }, async (view) => {
    await view.promise("complete");
    const rest = await seenIn(view);
    await scrub(view, 0.4);
    const moved = await seenIn(view);
    assert.ok(difference(moved.picture, rest.picture).offShare > 0.005, "it moves");
    const recorded = await seenOf(riggedSite("--as", "sequence"), (other) => scrub(other, 0.4));
    assertSeenAlike("moving-skins", moved, recorded, { mean: 0.3, offShare: 0.01 }, 1e-2);
  });
});

const bundles = { "app.js": "tests/browser/riggedPage.ts", "worker.js": "web/src/workers/worker.ts" };
const appDirectory = join(outputDirectory, "moving");

/** The picture of a site in a three.js app with shadows, and the paths that it has requested. */
async function inApp(site: string, seconds?: number): Promise<{ picture: Picture; paths: readonly string[] }> {
  let seen: { picture: Picture; paths: readonly string[] } | undefined;
  const server = (of: View["server"]): void => {
    serveApp(of, "/app.html", appDirectory, Object.keys(bundles));
  };
  await withPage(site, { size, path: "app.html", server }, async ({ page, requestedPaths }) => {
    await until("the app runs", () => page.evaluate(() => "loadModel" in window));
    await page.evaluate(() => window.loadModel("/scene.x3d", "/worker.js", 6));
    await page.evaluate(() => {
      window.addFloor(-1.6);
    });
    if (seconds !== undefined) await page.evaluate((time) => window.showSequence(time), seconds);
    await page.evaluate(() => window.drawMoment(undefined));
    seen = { picture: await screenshotOf(page), paths: requestedPaths };
  });
  assert.ok(seen);
  return seen;
}

soakTest(
  "a sequence and a lossless video are drawn and cast shadows in a three.js app as their frame does",
  async () => {
    await bundleApp(bundles, appDirectory);
    const frame = 14;
    const still = await inApp(stillBreath(frame));
    savePicture("moving-app", still.picture);
    const first = await inApp(stillBreath(0));
    assert.ok(difference(first.picture, still.picture).offShare > 0.01, "it moves");
    for (const [name, files, ...options] of [
      ["frames", /igf/],
      ["video", /webm/, "--as", "video"],
    ] as const) {
      const site = siteOfFrames("breath", breath, "--rate", String(rate), ...options);
      const { picture, paths } = await inApp(site, frame / rate);
      assertSamePicture(`moving-app-${name}`, picture, still.picture, { mean: 0.1, offShare: 0.002 });
      const kinds = new Set(paths.filter((path) => /igf|webm/.test(path)).map((path) => path.replace(/.*\./, "")));
      assert.equal(kinds.size, 1, Array.from(kinds).join());
      assert.match(Array.from(kinds).join(), files);
    }
  },
);

const keyCount = 9;
const edge = 16;

/** A document whose grid of edge² points a CoordinateInterpolator moves. */
function wavesDocument(): string {
  const numbers = Array.from({ length: edge * edge }, (_, n) => n);
  const pointsAt = (key: number): string =>
    numbers
      .map((n) => {
        const [x, z] = [(n % edge) / (edge - 1) - 0.5, Math.floor(n / edge) / (edge - 1) - 0.5];
        return [6 * x, Math.sin(7 * x + 0.5 * key) + 0.5 * Math.cos(5 * z + key), 6 * z]
          .map((value) => value.toFixed(4))
          .join(" ");
      })
      .join(" ");
  const faces = numbers
    .filter((n) => n % edge < edge - 1 && n < edge * (edge - 1))
    .map((n) => `${n} ${n + edge} ${n + edge + 1} -1 ${n} ${n + edge + 1} ${n + 1} -1`);
  const keys = Array.from({ length: keyCount }, (_, key) => key);
  return `<X3D version="4.0"><Scene>${camera}
    <TimeSensor DEF="clock" cycleInterval="3" loop="true"></TimeSensor>
    <CoordinateInterpolator DEF="waves" key="${keys.map((key) => key / (keyCount - 1)).join(" ")}" keyValue="${keys.map(pointsAt).join(" ")}"></CoordinateInterpolator>
    <Shape>${material}<IndexedFaceSet creaseAngle="3.2" solid="false" coordIndex="${faces.join(" ")}"><Coordinate DEF="grid" point="${pointsAt(0)}"></Coordinate></IndexedFaceSet></Shape>
    ${route("clock.fraction_changed", "waves.set_fraction")}${route("waves.value_changed", "grid.set_point")}</Scene></X3D>`;
}

soakTest("a document with a CoordinateInterpolator is drawn as its site with a sequence at each key", async () => {
  const text = wavesDocument();
  const file = join(outputDirectory, "waves.x3d");
  writeFileSync(file, text);
  const site = siteOf(file, "--as", "sequence");
  assert.match(pageOf(site), /<CoordinateInterpolator[^>]*url=/i);
  const inner = /<Scene>([\s\S]*)<\/Scene>/.exec(text)![1]!;
  const source = sceneOf("moving-waves", { trefoil: siteOfGenerated("trefoil") }, inner);
  await withPage(source, { size }, async (view) => {
    await view.promise("complete");
    await withPage(site, { size }, async (other) => {
      await other.promise("complete");
      let before: Picture | undefined;
      for (const key of [0, 3, 5, 8]) {
        for (const page of [view, other]) await scrub(page, key / (keyCount - 1));
        const expected = await view.picture();
        assertSamePicture(`moving-waves-${key}`, await other.picture(), expected, { mean: 0.2, offShare: 0.001 });
        assert.ok(before === undefined || difference(before, expected).offShare > 0.02, "it moves");
        before = expected;
      }
      savePicture("moving-waves", before!);
    });
  });
});
