// Tests that near patches are requested first (paper section 5.4): the hall is one mesh that consists of patches,
// displayed from either of its ends, once as if over HTTP/2, which allows more requests at a time.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { http1SlotCount, http2SlotCount } from "../../web/src/scheduler/downloadSlots.ts";
import { until, withPage, type View } from "./harness.ts";
import { converter, outputDirectory } from "./paths.ts";
import { gate } from "./server.ts";
import { pageOf, siteOf, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

type Point = readonly [number, number, number];

interface Camera {
  readonly name: string;
  readonly eye: Point;
  /** Unit vector of the view direction. */
  readonly direction: Point;
  readonly orientation: string;
  /** As nextHopProtocol states it; over HTTP/2 there are more request slots. */
  readonly protocol: string;
  readonly slots: number;
}

const fieldOfView = 1;
/** The hall is 28 m wide. */
const cameras: readonly Camera[] = [
  {
    name: "left",
    eye: [-12.5, 3, 2],
    direction: [1, 0, 0],
    orientation: `0 1 0 ${-Math.PI / 2}`,
    protocol: "h2",
    slots: http2SlotCount,
  },
  {
    name: "right",
    eye: [12.5, 3, 2],
    direction: [-1, 0, 0],
    orientation: `0 1 0 ${Math.PI / 2}`,
    protocol: "http/1.1",
    slots: http1SlotCount,
  },
];

/** Functions that make a page believe in a protocol, since the tests' server supports only HTTP/1.1; self-contained. */
const pretendProtocol: Readonly<Record<string, () => void>> = {
  h2: () => {
    Object.defineProperty(PerformanceResourceTiming.prototype, "nextHopProtocol", { get: () => "h2" });
  },
  "http/1.1": () => undefined,
};

/** The generated hall, exported to one mesh without instances. */
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
  /** Minimum and maximum angle between the view direction and directions to the patch, in radians. */
  readonly angles: readonly [number, number];
}

const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The patches as seen by a camera, computed from their boxes in the page. */
function patchesSeenBy({ eye, direction }: Camera, page: string): Map<string, SeenPatch> {
  const numbersOf = (tag: string, field: string): Point =>
    (new RegExp(`\\s${field}="([^"]*)"`).exec(tag)?.[1] ?? "").split(" ").map(Number) as unknown as Point;
  return new Map(
    (page.match(/<GeometryPatch[^>]*>/g) ?? []).map((tag) => {
      const [center, size] = [numbersOf(tag, "bboxCenter"), numbersOf(tag, "bboxSize")];
      const url = /\sdata="([^"#]*)/.exec(tag)?.[1] ?? "";
      const away: Point = [center[0] - eye[0], center[1] - eye[1], center[2] - eye[2]];
      const [radius, distance] = [Math.hypot(...size) / 2, Math.hypot(...away)];
      const angle = Math.acos(dot(away, direction) / distance);
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

/** Asserts that no patch follows one that is 10 % smaller. */
function assertLargestFirst(patches: readonly SeenPatch[], name: string): void {
  let minSize = Infinity;
  for (const { url, size } of patches) {
    assert.ok(size < 1.1 * minSize, `${name}: ${url} (${size}) after one of ${minSize}`);
    minSize = Math.min(minSize, size);
  }
}

soakTest(
  "patches of a hall that are largest on the screen are requested first, and those behind the camera last, from either end",
  async () => {
    const middles: number[] = [];
    for (const camera of cameras) {
      const { name, eye, orientation } = camera;
      const site = variantOf(hallOfOneMesh(), name, (page) =>
        page.replace(
          /<Viewpoint[^>]*>/i,
          `<Viewpoint position="${eye.join(" ")}" orientation="${orientation}" fieldOfView="${fieldOfView}">`,
        ),
      );
      const patches = patchesSeenBy(camera, pageOf(site));
      const { closed, open } = gate();
      const server = (server: View["server"]): void =>
        void server.when((path) => patches.has(path.slice(1)), { hold: closed });
      await withPage(site, { server, before: pretendProtocol[camera.protocol]! }, async (view) => {
        // A worker may request a file that the page has requested, and gets the same answer.
        const requestedUrls = (): string[] => [...new Set(view.requestedPaths)].filter((url) => patches.has(url));
        await until("all slots are taken", () => requestedUrls().length >= camera.slots);
        assert.equal(requestedUrls().length, camera.slots, `${name}: concurrent requests over ${camera.protocol}`);
        open();
        await view.promise("complete", "x3d", 60);
        const requested = requestedUrls().flatMap((url) => patches.get(url) ?? []);
        assert.equal(requested.length, patches.size);
        assert.ok(requested.length >= 20, `${requested.length} patches`);
        // 0.5 is half the height of the view, 0.8 more than half its diagonal.
        const isBehind = ({ angles: [nearest] }: SeenPatch): boolean => nearest > 0.8;
        const isAhead = ({ angles: [nearest] }: SeenPatch): boolean => nearest < 0.3;
        assertLargestFirst(requested.filter(isAhead), name);
        assertLargestFirst(requested.filter(isBehind), name);
        assert.ok(requested.some(isBehind), "there are patches behind the camera");
        assert.ok(
          requested.findLastIndex(isAhead) < requested.findIndex(isBehind),
          `${name}: patches behind the camera were requested early`,
        );
        const first = requested.slice(0, requested.length / 4);
        middles.push(first.reduce((sum, { x }) => sum + x, 0) / first.length);
      });
    }
    assert.ok(middles[0]! + 8 < middles[1]!, `the first quarter lies around ${middles.join(" and ")}`);
  },
);
