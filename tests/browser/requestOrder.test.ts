// Near things first (paper section 5.4): the hall, all of it one mesh cut into
// patches, as two visitors see it come who stand at its two ends, one of them over
// a line on which more files come at a time.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { http1SlotCount, http2SlotCount } from "../../web/src/scheduler/downloadSlots.ts";
import { until, withPage, type View } from "./harness.ts";
import { converter, outputDirectory } from "./paths.ts";
import { gate } from "./server.ts";
import { pageOf, siteOf, variantOf } from "./sites.ts";

type Point = readonly [number, number, number];

interface Visitor {
  readonly name: string;
  readonly eye: Point;
  /** Where they look, of length 1. */
  readonly gaze: Point;
  readonly orientation: string;
  /** As the browser tells it; by HTTP/2 more files come at a time. */
  readonly protocol: string;
  readonly slots: number;
}

const fieldOfView = 1;
/** The hall is 28 m wide. */
const visitors: readonly Visitor[] = [
  {
    name: "left",
    eye: [-12.5, 3, 2],
    gaze: [1, 0, 0],
    orientation: `0 1 0 ${-Math.PI / 2}`,
    protocol: "h2",
    slots: http2SlotCount,
  },
  {
    name: "right",
    eye: [12.5, 3, 2],
    gaze: [-1, 0, 0],
    orientation: `0 1 0 ${Math.PI / 2}`,
    protocol: "http/1.1",
    slots: http1SlotCount,
  },
];

/** Self-contained: the test's server knows but one protocol. */
const pretend: Readonly<Record<string, () => void>> = {
  h2: () => {
    Object.defineProperty(PerformanceResourceTiming.prototype, "nextHopProtocol", { get: () => "h2" });
  },
  "http/1.1": () => undefined,
};

/** The generated hall's triangles without what tells its seats apart. */
function hallOfOneMesh(): string {
  const file = join(outputDirectory, "whole-hall.ply");
  if (!existsSync(file)) {
    mkdirSync(outputDirectory, { recursive: true });
    const imgeo = (...words: string[]): void =>
      void execFileSync(converter, words, { stdio: ["ignore", "ignore", "inherit"] });
    const sample = join(outputDirectory, "small-hall.glb");
    imgeo("sample", "hall", "--seats", "12", "-o", sample);
    imgeo("export", siteOf(sample), "-o", file);
  }
  return siteOf(file, "--patch-vertices", "2500");
}

interface SeenPatch {
  readonly url: string;
  /** x coordinate of the patch's center. */
  readonly x: number;
  /** Its diameter over its distance. */
  readonly size: number;
  /** Between the gaze and the nearest and farthest direction to it, in radians. */
  readonly angles: readonly [number, number];
}

const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The boxes in the page are all that a visitor's eye needs. */
function patchesSeenBy({ eye, gaze }: Visitor, page: string): Map<string, SeenPatch> {
  const numbersOf = (tag: string, field: string): Point =>
    (new RegExp(`\\s${field}="([^"]*)"`).exec(tag)?.[1] ?? "").split(" ").map(Number) as unknown as Point;
  return new Map(
    (page.match(/<GeometryPatch[^>]*>/g) ?? []).map((tag) => {
      const [center, size] = [numbersOf(tag, "bboxCenter"), numbersOf(tag, "bboxSize")];
      const url = /\sdata="([^"#]*)/.exec(tag)?.[1] ?? "";
      const away: Point = [center[0] - eye[0], center[1] - eye[1], center[2] - eye[2]];
      const [radius, distance] = [Math.hypot(...size) / 2, Math.hypot(...away)];
      const angle = Math.acos(dot(away, gaze) / distance);
      const spread = distance > radius ? Math.asin(radius / distance) : Math.PI;
      return [
        url,
        {
          url,
          x: center[0],
          size: (2 * radius) / Math.max(distance, radius),
          angles: [angle - spread, angle + spread],
        },
      ];
    }),
  );
}

/** No patch comes after one that is a tenth smaller. */
function assertLargestFirst(patches: readonly SeenPatch[], who: string): void {
  let minSize = Infinity;
  for (const { url, size } of patches) {
    assert.ok(size < 1.1 * minSize, `${who}: ${url} (${size}) after one of ${minSize}`);
    minSize = Math.min(minSize, size);
  }
}

test("of a hall comes first what is seen largest, last what is behind one, from whichever end", async () => {
  const middles: number[] = [];
  for (const visitor of visitors) {
    const { name, eye, orientation } = visitor;
    const site = variantOf(hallOfOneMesh(), name, (page) =>
      page.replace(
        /<Viewpoint[^>]*>/i,
        `<Viewpoint position="${eye.join(" ")}" orientation="${orientation}" fieldOfView="${fieldOfView}">`,
      ),
    );
    const patches = patchesSeenBy(visitor, pageOf(site));
    const { closed, open } = gate();
    const server = (server: View["server"]): void =>
      void server.when((path) => patches.has(path.slice(1)), { hold: closed });
    await withPage(site, { server, before: pretend[visitor.protocol]! }, async (view) => {
      const count = (): number => view.requestedPaths.filter((url) => patches.has(url)).length;
      await until("all slots are taken", () => count() >= visitor.slots);
      assert.equal(count(), visitor.slots, `${name}: files asked for at a time, over ${visitor.protocol}`);
      open();
      await view.promise("complete", "x3d", 60);
      const asked = view.requestedPaths.flatMap((url) => patches.get(url) ?? []);
      assert.equal(asked.length, patches.size);
      assert.ok(asked.length >= 20, `${asked.length} patches`);
      // 0.5 is half the height of the view, 0.8 more than half its diagonal.
      const isBehind = ({ angles: [nearest] }: SeenPatch): boolean => nearest > 0.8;
      const isBefore = ({ angles: [nearest] }: SeenPatch): boolean => nearest < 0.3;
      assertLargestFirst(asked.filter(isBefore), name);
      assertLargestFirst(asked.filter(isBehind), name);
      assert.ok(asked.some(isBehind), "something is behind the visitor");
      assert.ok(asked.findLastIndex(isBefore) < asked.findIndex(isBehind), `${name}: what is behind came early`);
      const first = asked.slice(0, asked.length / 4);
      middles.push(first.reduce((sum, { x }) => sum + x, 0) / first.length);
    });
  }
  assert.ok(middles[0]! + 8 < middles[1]!, `the first quarter lies around ${middles.join(" and ")}`);
});
