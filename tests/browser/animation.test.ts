// Tests documents with TimeSensors, interpolators, ROUTEs and sensors in one page: what moves is in the attributes and
// on the screen, what stands draws no frame.

import assert from "node:assert/strict";
import { test } from "node:test";
import { assertSamePicture, savePicture } from "./compare.ts";
import { finalPicture, settle, until, withPage, type View } from "./harness.ts";
import type { Picture } from "./png.ts";
import { route, sceneOf } from "./scenes.ts";
import type { TestServer } from "./server.ts";
import { siteOfGenerated } from "./sites.ts";

const size = { width: 320, height: 240 };

const shape = (geometry: string, color = "0.8 0.8 0.8", name = ""): string =>
  `<Shape><Appearance><Material${name && ` DEF="${name}"`} diffuseColor="${color}"></Material></Appearance>${geometry}</Shape>`;
const box = `<Box size="1 1 1"></Box>`;

const scene = `<NavigationInfo transitionType="TELEPORT"></NavigationInfo><Viewpoint position="0 0 10"></Viewpoint>
  <TimeSensor DEF="clock" cycleInterval="2" loop="true"></TimeSensor>
  <PositionInterpolator DEF="way" key="0 0.5 1" keyValue="-3 2 0  3 2 0  -3 2 0"></PositionInterpolator>
  <OrientationInterpolator DEF="turn" key="0 1" keyValue="0 0 1 0  0 0 1 3"></OrientationInterpolator>
  <ColorInterpolator DEF="hue" key="0 1" keyValue="1 0 0  0 1 0"></ColorInterpolator>
  <ScalarInterpolator DEF="dim" key="0 1" keyValue="1 0.2"></ScalarInterpolator>
  <IntegerSequencer DEF="which" key="0 0.25 0.5" keyValue="0 1 -1"></IntegerSequencer>
  <CoordinateInterpolator DEF="wave" key="0 1" keyValue="-1 -1 0 1 -1 0 0 1 0  -1 -1 0 1 -1 0 0 0 2"></CoordinateInterpolator>
  <PointLight DEF="lamp" location="0 0 6"></PointLight>
  <Transform DEF="outer"><Transform DEF="inner" scale="0.7 0.7 0.7">${shape(box, "0.5 0.5 1", "paint")}</Transform></Transform>
  <Switch DEF="choice" whichChoice="0"><Transform translation="-3 0 0">${shape(box)}</Transform><Transform translation="-3 0 0">${shape("<Sphere></Sphere>")}</Transform></Switch>
  <Transform translation="-3 -2.2 0">${shape(`<IndexedFaceSet solid="false" coordIndex="0 1 2 -1"><Coordinate DEF="points" point="-1 -1 0 1 -1 0 0 1 0"></Coordinate></IndexedFaceSet>`)}</Transform>
  <Group><TouchSensor DEF="touch"></TouchSensor><BooleanToggle DEF="toggle"></BooleanToggle>
    <IntegerTrigger DEF="never" integerKey="1"></IntegerTrigger>
    <Transform translation="3 0 0">${shape("<Sphere radius='0.6'></Sphere>", "1 1 0")}</Transform></Group>
  <Switch DEF="light" whichChoice="-1"><DirectionalLight></DirectionalLight></Switch>
  <Group><PlaneSensor DEF="plane" minPosition="-9 0" maxPosition="9 0"></PlaneSensor>
    <Transform DEF="knob" translation="0 -2 0">${shape(box, "0 1 1")}</Transform></Group>
  <ProximitySensor DEF="near" size="4 4 4"></ProximitySensor>
  ${route("clock.fraction_changed", "way.set_fraction")}${route("way.value_changed", "outer.set_translation")}
  ${route("clock.fraction_changed", "turn.set_fraction")}${route("turn.value_changed", "inner.rotation")}
  ${route("clock.fraction_changed", "hue.set_fraction")}${route("hue.value_changed", "paint.diffuseColor")}
  ${route("clock.fraction_changed", "dim.set_fraction")}${route("dim.value_changed", "lamp.intensity")}
  ${route("clock.fraction_changed", "which.set_fraction")}${route("which.value_changed", "choice.whichChoice")}
  ${route("clock.fraction_changed", "wave.set_fraction")}${route("wave.value_changed", "points.set_point")}
  ${route("touch.isActive", "never.set_boolean")}${route("touch.touchTime", "nobody.set_startTime")}
  ${route("plane.translation_changed", "knob.set_translation")}`;

const framesOf = ({ page }: View): Promise<number> =>
  page.evaluate(
    () => (document.querySelector("x3d") as unknown as { statistics: { frames: number } }).statistics.frames,
  );

/** The numbers of an attribute. */
async function numbersOf({ page }: View, name: string, attribute: string): Promise<number[]> {
  const text = await page.locator(`[DEF="${name}"]`).getAttribute(attribute);
  return (text ?? "").split(" ").map(Number);
}

async function set({ page }: View, name: string, attribute: string, value: string): Promise<void> {
  await page.evaluate(
    ([selector, key, text]) => {
      document.querySelector(selector)!.setAttribute(key, text);
    },
    [`[DEF="${name}"]`, attribute, value] as const,
  );
}

function assertNear(actual: readonly number[], expected: readonly number[], tolerance = 1e-6): void {
  assert.equal(actual.length, expected.length);
  actual.forEach((value, i) => {
    assert.ok(Math.abs(value - expected[i]!) <= tolerance, `${actual.join(" ")} is not ${expected.join(" ")}`);
  });
}

/** Waits until no frame is due and the attributes of `outer` have not changed for 200 ms. */
async function untilStands(view: View): Promise<void> {
  const state = async (): Promise<string> =>
    [await framesOf(view), ...(await numbersOf(view, "outer", "translation"))].join(" ");
  await settle(view.page);
  await until("the scene stands", async () => {
    const before = await state();
    await view.page.waitForTimeout(200);
    return (await state()) === before;
  });
}

/** With reduced motion nothing starts by itself, and a script scrubs. */
async function assertScrubbed(view: View, site: string): Promise<void> {
  const { page } = view;
  const stood = await framesOf(view);
  await page.waitForTimeout(300);
  assert.equal(await framesOf(view), stood, "frames are drawn although nothing moves");
  assert.equal(await page.locator('[DEF="outer"]').getAttribute("translation"), null, "a clock has started");
  await page.evaluate(() => {
    const seen: unknown[] = ((globalThis as Record<string, unknown>).seen = []);
    document.querySelector('[DEF="way"]')!.addEventListener("outputchange", (event) => {
      const { fieldName, value } = event as unknown as { fieldName: string; value: { x: number; toString(): string } };
      seen.push([fieldName, value.x, value.toString()]);
    });
    const way = document.querySelector<Element & { onoutputchange?: unknown }>('[DEF="way"]')!;
    way.onoutputchange = () => seen.push("replaced");
    way.onoutputchange = function (this: unknown, { target }: Event) {
      seen.push(["handler", this === way && target === way]);
      way.onoutputchange = null;
    };
  });
  await set(view, "clock", "set_fraction", "0.25");
  await until("the frame is drawn", async () => (await framesOf(view)) > stood);
  assertNear(await numbersOf(view, "outer", "translation"), [0, 2, 0]);
  assertNear(await numbersOf(view, "inner", "rotation"), [0, 0, 1, 0.75]);
  assertNear(await numbersOf(view, "paint", "diffuseColor"), [1, 0.5, 0]);
  assertNear(await numbersOf(view, "choice", "whichChoice"), [1]);
  assertNear(await numbersOf(view, "lamp", "intensity"), [0.8]);
  assert.deepEqual(await page.evaluate(() => (globalThis as Record<string, unknown>).seen), [
    ["value_changed", 0, "0 2 0"],
    ["handler", true],
  ]);
  assert.equal(
    await page.evaluate(() => {
      const way = document.querySelector('[DEF="way"]') as unknown as {
        getFieldValue: (name: string) => { y: number };
      };
      return way.getFieldValue("value_changed").y;
    }),
    2,
  );
  await set(view, "clock", "fraction", "0.4");
  await until(
    "the attributes have followed",
    async () => Math.abs((await numbersOf(view, "outer", "translation"))[0]! - 1.8) < 1e-6,
  );
  const picture = await view.picture();
  const text = await page.evaluate(() => {
    const copy = document.querySelector("x3d")!.cloneNode(true) as Element;
    copy.querySelector("imgeo-view")?.remove();
    return copy.outerHTML;
  });
  const replace = (html: Buffer): string => html.toString().replace(/<X3D[\s\S]*<\/X3D>/i, () => text);
  const fresh = await finalPicture(site, { size, server: (server) => server.when(/^\/$/, { replace }) });
  assertSamePicture("animation-scrubbed", picture, fresh, { mean: 0.05, offShare: 0.001 });
}

/** Geometry that moves keeps its buffers, and has loaded once. */
async function assertKeepsMemory(view: View): Promise<void> {
  const { page } = view;
  const memory = (): Promise<number[]> =>
    page.evaluate(() => {
      const { statistics } = document.querySelector("x3d") as unknown as {
        statistics: { geometries: number; textures: number; programs: number; bufferBytes: number };
      };
      return [statistics.geometries, statistics.textures, statistics.programs, statistics.bufferBytes];
    });
  await page.evaluate(() => {
    (globalThis as Record<string, unknown>).loads = 0;
    document.querySelector("x3d")!.addEventListener(
      "load",
      () => {
        (globalThis as unknown as { loads: number }).loads += 1;
      },
      { capture: true },
    );
  });
  let before: number[] = [];
  for (let step = 0; step < 8; step++) {
    await set(view, "wave", "set_fraction", String(step / 8));
    await view.picture();
    if (step === 3) before = await memory();
  }
  assert.deepEqual(await memory(), before);
  assert.equal(await page.evaluate(() => (globalThis as Record<string, unknown>).loads), 0, "it has loaded again");
  await until("its attribute has followed", async () => {
    const points = await numbersOf(view, "points", "point");
    return points.length === 9 && Math.abs(points[8]! - 2 * 0.875) < 1e-6;
  });
}

async function assertPlays(view: View): Promise<void> {
  const { page } = view;
  const before = await framesOf(view);
  await page.evaluate(() => {
    document.querySelector("x3d")!.setAttribute("paused", "false");
  });
  await until("it plays", async () => (await framesOf(view)) > before + 3);
  await page.evaluate(() => {
    document.querySelector("x3d")!.setAttribute("paused", "");
  });
  await untilStands(view);
  const [frames, position] = [await framesOf(view), await numbersOf(view, "outer", "translation")];
  await page.waitForTimeout(400);
  assert.equal(await framesOf(view), frames, "a paused scene draws frames");
  assert.deepEqual(await numbersOf(view, "outer", "translation"), position);
  await assertStandsWhileHidden(view);
  await page.evaluate(() => {
    document.querySelector("x3d")!.removeAttribute("paused");
  });
  await untilStands(view);
  const stood = await framesOf(view);
  await page.waitForTimeout(300);
  assert.equal(await framesOf(view), stood, "what has started by itself runs although the user prefers reduced motion");
}

/** In a hidden tab nothing is drawn, and what moved goes on from where it was. */
async function assertStandsWhileHidden(view: View): Promise<void> {
  const { page } = view;
  const fraction = (): Promise<number> =>
    page.evaluate(() => {
      const clock = document.querySelector('[DEF="clock"]') as unknown as { getFieldValue: (name: string) => number };
      return clock.getFieldValue("fraction_changed");
    });
  await page.evaluate(() => {
    Object.defineProperty(document, "hidden", { value: true, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
    document.querySelector("x3d")!.setAttribute("paused", "false");
  });
  await page.waitForTimeout(100); // a frame that was asked for before is drawn
  const [frames, stood] = [await framesOf(view), await fraction()];
  await page.waitForTimeout(600);
  assert.deepEqual([await framesOf(view), await fraction()], [frames, stood], "a hidden tab plays");
  const [after, shownSeconds] = await page.evaluate(async (hiddenFrames) => {
    const x3d = document.querySelector("x3d") as unknown as { statistics: { frames: number } };
    const clock = document.querySelector('[DEF="clock"]') as unknown as { getFieldValue: (name: string) => number };
    Object.defineProperty(document, "hidden", { value: false, configurable: true });
    const shown = performance.now();
    document.dispatchEvent(new Event("visibilitychange"));
    while (x3d.statistics.frames <= hiddenFrames) await new Promise(requestAnimationFrame);
    return [clock.getFieldValue("fraction_changed"), (performance.now() - shown) / 1000] as const;
  }, frames);
  const cycle = 2; // s
  assert.ok(
    (after - stood + 1) % 1 < shownSeconds / cycle + 0.05,
    `the clock has gone from ${stood} to ${after} although the tab was shown for ${shownSeconds} s only`,
  );
}

async function assertSensors(view: View): Promise<void> {
  const { page } = view;
  const unit = size.height / 2 / Math.tan(0.7854 / 2) / 10;
  const at = (x: number, y: number): [number, number] => [size.width / 2 + x * unit, size.height / 2 - y * unit];
  await page.evaluate(() => {
    const seen: string[] = ((globalThis as Record<string, unknown>).touches = [] as string[]);
    document.querySelector('[DEF="touch"]')!.addEventListener("outputchange", (event) => {
      seen.push((event as unknown as { fieldName: string }).fieldName);
    });
  });
  await page.mouse.move(...at(3, 0));
  await page.mouse.down();
  await page.mouse.up();
  const touches = (): Promise<string[]> =>
    page.evaluate(() => (globalThis as Record<string, unknown>).touches as string[]);
  await until("the touch has ended", async () => (await touches()).includes("touchTime"));
  assert.deepEqual(
    new Set(await touches()),
    new Set(["isOver", "hitPoint_changed", "hitNormal_changed", "isActive", "touchTime"]),
  );
  const depth = 0.5; // the front of the box
  const front = (x: number, y: number): [number, number] => at((x * 10) / (10 - depth), (y * 10) / (10 - depth));
  await page.mouse.move(...front(0, -2));
  await page.mouse.down();
  await page.mouse.move(...front(1, -1.5));
  await page.mouse.move(...front(2, -1));
  await page.mouse.up();
  await until(
    "the knob has followed",
    async () => Math.abs((await numbersOf(view, "knob", "translation"))[0]! - 2) < 0.05,
  );
  const [, y] = await numbersOf(view, "knob", "translation");
  assertNear([y!], [0], 1e-9);
  assertNear((await numbersOf(view, "plane", "offset")).slice(1), [0, 0], 1e-9);
  await page.evaluate(() => {
    const viewpoint = document.querySelector("viewpoint")!;
    viewpoint.setAttribute("position", "0 0 1.5");
  });
  await until("the viewer is near", () =>
    page.evaluate(() => {
      const near = document.querySelector('[DEF="near"]') as unknown as { getFieldValue: (name: string) => unknown };
      return near.getFieldValue("isActive") === true;
    }),
  );
}

const inlined = `<X3D version="4.0"><Scene><Group><TouchSensor DEF="touch"></TouchSensor>
  <Transform DEF="t">${shape('<Box size="4 4 0.1"></Box>')}</Transform></Group>
  <BooleanFilter DEF="press"></BooleanFilter><BooleanToggle DEF="runs" toggle="true"></BooleanToggle>
  ${route("touch.isActive", "press.set_boolean")}${route("press.inputTrue", "runs.set_boolean")}${route("runs.toggle", "c.set_enabled")}
  <TimeSensor DEF="c" loop="true"></TimeSensor>
  <PositionInterpolator DEF="i" key="0 1" keyValue="0 0 0 1 0 0"></PositionInterpolator>
  ${route("c.fraction_changed", "i.set_fraction")}${route("i.value_changed", "t.translation")}
  <EXPORT localDEF="touch"/></Scene></X3D>`;

/**
 * An inlined document plays when the page's own clock does not, and its TouchSensor stops it, and sends an event to the
 * page's document, which imports it.
 */
async function assertInlinedPlays(view: View): Promise<void> {
  await set(view, "clock", "enabled", "false");
  await view.page.evaluate(() => {
    document.querySelector("x3d")!.setAttribute("paused", "false");
    const inline = document.createElement("inline");
    inline.setAttribute("url", "inlined.x3d");
    inline.setAttribute("DEF", "machine");
    document.querySelector("scene")!.append(inline);
    document.querySelector("scene")!.insertAdjacentHTML(
      "beforeend",
      `<import inlineDEF="machine" importedDEF="touch" AS="button"></import><booleanfilter DEF="pressed"></booleanfilter>
      <route fromNode="button" fromField="isActive" toNode="pressed" toField="set_boolean"></route>`,
    );
  });
  const before = await framesOf(view);
  await until("the inlined document plays", async () => (await framesOf(view)) > before + 30);
  await view.page.mouse.click(size.width / 2, size.height / 2);
  await until("the page's document has its event", () =>
    view.page.evaluate(() => {
      const pressed = document.querySelector('[DEF="pressed"]') as unknown as {
        getFieldValue: (name: string) => unknown;
      };
      return pressed.getFieldValue("inputTrue") === true;
    }),
  );
  await untilStands(view);
  await view.page.evaluate(() => {
    document.querySelector("x3d")!.setAttribute("paused", "");
  });
}

test("a scene moves as its ROUTEs say, by its clocks, its scripts and the pointer, and stands where nothing moves", async () => {
  const site = sceneOf("animation", { trefoil: siteOfGenerated("trefoil") }, scene);
  const server = (of: TestServer): void => {
    of.put("/inlined.x3d", inlined);
  };
  await withPage(site, { size, server }, async (view) => {
    await view.promise("complete");
    await until("the animation is loaded", () =>
      view.page.evaluate(() => "getFieldValue" in document.querySelector('[DEF="clock"]')!),
    );
    await assertScrubbed(view, site);
    await assertKeepsMemory(view);
    await assertPlays(view);
    await assertSensors(view);
    await assertInlinedPlays(view);
  });
});

/** The first and the last column of a picture that the green shape covers; undefined where it is not in the picture. */
function columnsOfGreen({ width, height, channels, data }: Picture): readonly [number, number] | undefined {
  const columns = Array.from({ length: width }, (_, x) => x).filter((x) =>
    Array.from({ length: height }, (_, y) => channels * (y * width + x)).some(
      (at) => data[at + 1]! > 60 && data[at]! < 40 && data[at + 2]! < 40,
    ),
  );
  const [first, last] = [columns[0], columns.at(-1)];
  return first === undefined || last === undefined ? undefined : [first, last];
}

test("without a Viewpoint the start view shows the whole motion, and stands while the scene moves", async () => {
  const moving = `<TimeSensor DEF="clock" cycleInterval="2"></TimeSensor>
    <PositionInterpolator DEF="way" key="0 1" keyValue="-6 0 0  6 0 0"></PositionInterpolator>
    <Transform DEF="t" translation="-6 0 0">${shape(box, "0 0.8 0")}</Transform>
    ${route("clock.fraction_changed", "way.set_fraction")}${route("way.value_changed", "t.translation")}`;
  const site = sceneOf("animation-unframed", { trefoil: siteOfGenerated("trefoil") }, moving);
  await withPage(site, { size }, async (view) => {
    await view.promise("complete");
    await until("the animation is loaded", () =>
      view.page.evaluate(() => "getFieldValue" in document.querySelector('[DEF="clock"]')!),
    );
    const columnsAt = async (fraction: number): Promise<readonly [number, number]> => {
      await set(view, "clock", "set_fraction", String(fraction));
      const picture = await view.picture();
      savePicture(`animation-unframed-${fraction}`, picture);
      const columns = columnsOfGreen(picture);
      assert.ok(columns, `the shape is not in the picture of ${fraction}`);
      return columns;
    };
    const [left, middle, right] = [await columnsAt(0), await columnsAt(0.5), await columnsAt(1)];
    assert.ok(left[0] > 0 && left[1] < middle[0], `${left.join()} is not left of ${middle.join()}`);
    assert.ok(right[0] > middle[1] && right[1] < size.width - 1, `${right.join()} is not right of ${middle.join()}`);
  });
});
