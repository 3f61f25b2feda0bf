// Tests picking and pointer events: triangle, vertex, position and normal at known pixels are compared with rays
// through the reference decoder's mesh, and events are dispatched on the shape's element as the browser's own are.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { ImgeoView, ShapePointerEvent } from "../../web/src/dom/index.ts";
import { largePictureSize, settle, until, withPage, type View } from "./harness.ts";
import { firstHit, rayThrough, vectorAt, type RayHit } from "./rays.ts";
import { dot, minus, type Vec3 } from "./vectors.ts";
import { referenceSettingsOf } from "./reference.ts";
import { decodeCompactSite } from "./compactDecoder.ts";
import { decodeSite, type PlainPatch } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

interface PointerRecord {
  type: string;
  target: string;
  triangleId: number | null;
  vertexId: number;
  patch: number;
  position?: Vec3;
  normal?: Vec3 | null;
  hitPnt?: Vec3;
}

declare global {
  interface Window {
    pointerEvents: PointerRecord[];
  }
}

/** Self-contained: records pointer events that have bubbled up to the document. */
function recordPointerEvents(): void {
  window.pointerEvents = [];
  const types = [
    "pointerdown",
    "pointerup",
    "pointermove",
    "pointerover",
    "pointerout",
    "click",
    "mousedown",
    "mousemove",
    "mouseover",
  ];
  for (const type of types) {
    document.addEventListener(type, (event) => {
      if (!(event.target instanceof Element)) return;
      const { worldPosition: p, worldNormal: n, triangleId, vertexId, patch, hitPnt } = event as ShapePointerEvent;
      const vectorOf = (v: { x: number; y: number; z: number } | null): Vec3 | null => v && [v.x, v.y, v.z];
      const { localName, id } = event.target;
      window.pointerEvents.push({
        type,
        triangleId,
        vertexId,
        patch,
        target: localName + (id && `#${id}`),
        ...("worldPosition" in event && { position: vectorOf(p)!, normal: vectorOf(n), hitPnt: [...hitPnt] as Vec3 }),
      });
    });
  }
}

async function withSite(
  site: string,
  use: (view: View) => Promise<void>,
  change: (html: string) => string = (html) => html,
): Promise<void> {
  const server = (server: View["server"]): void => {
    server.when(/^\/$/, { replace: (html) => change(html.toString()) });
  };
  await withPage(site, { size: largePictureSize, before: recordPointerEvents, server }, async (view) => {
    await view.promise("complete");
    await settle(view.page);
    await use(view);
  });
}

async function pointerEvents({ page }: View, type: string): Promise<PointerRecord[]> {
  return (await page.evaluate(() => window.pointerEvents)).filter((event) => event.type === type);
}

/** Clicks at a pixel; returns the click event that the document receives. */
async function clickAt(view: View, x: number, y: number): Promise<PointerRecord> {
  await view.page.evaluate(() => {
    window.pointerEvents = [];
  });
  await view.page.mouse.click(x, y);
  const clicks = await pointerEvents(view, "click");
  assert.equal(clicks.length, 1, `one click at ${x}, ${y}`);
  return clicks[0]!;
}

function expectedAt(site: string, patches: PlainPatch[], x: number, y: number): RayHit | undefined {
  return firstHit(rayThrough(referenceSettingsOf(pageOf(site)).viewpoint, largePictureSize, x, y), patches);
}

/** Pixels over the whole picture, in no regular pattern. */
const pixels = Array.from({ length: 24 }, (_, i) => ({
  x: Math.round(largePictureSize.width * (0.15 + 0.7 * ((i * 0.618034) % 1))),
  y: Math.round(largePictureSize.height * (0.06 + 0.88 * ((i + 0.5) / 24))),
}));

function assertNear(actual: Vec3 | null | undefined, expected: Vec3, tolerance: number, what: string): void {
  assert.ok(actual, `${what} is missing`);
  const off = Math.hypot(...minus(actual, expected));
  assert.ok(off <= tolerance, `${what} is ${actual.join(" ")}, ${off} from ${expected.join(" ")}`);
}

const sites: string[][] = [
  ["--container", "sig", "--index", "off"],
  ["--container", "bg", "--primitives", "strips"],
  ["--container", "bg", "--layout", "interleaved", "--coord-type", "float32"],
  ["--position-bits", "24"],
  ["--profile", "compact", "--patch-vertices", "1000"],
];

/** More options, and the other container for each option of `sites`. */
const otherSites: string[][] = [
  ["--container", "sig", "--patch-vertices", "1000"],
  ["--container", "bg", "--normals", "octahedral"],
  ["--container", "bg", "--normal-bits", "32", "--position-bits", "8"],
  ["--container", "bg", "--patch-vertices", "1000"],
  ["--container", "bg", "--index", "off"],
  ["--container", "sig", "--primitives", "strips"],
  ["--container", "sig", "--normals", "octahedral"],
  ["--container", "bg", "--layout", "interleaved", "--coord-type", "int16"],
];

describe("a click event has the triangle, vertex, position and normal at its pixel", () => {
  for (const options of [...sites, ...otherSites]) {
    (options.includes("compact") ? test : soakTest)(options.join(" "), async () => {
      const isCompact = options.includes("compact");
      const site = siteOfGenerated("trefoil", ...(isCompact ? [] : ["--profile", "classic"]), ...options);
      // A third byte would be invisible with this camera, so it is not requested.
      const patches = isCompact ? decodeCompactSite(site) : decodeSite(site, 2);
      await withSite(site, async (view) => {
        let hits = 0;
        for (const { x, y } of pixels) {
          const expected = expectedAt(site, patches, x, y);
          const click = await clickAt(view, x, y);
          assert.equal(click.target, expected ? "shape" : "imgeo-view", `at ${x}, ${y}`);
          if (!expected) continue;
          hits += 1;
          assert.deepEqual([click.patch, click.triangleId], [expected.patch, expected.triangle]);
          assert.equal(
            click.vertexId,
            expected.vertices[expected.barycentric.indexOf(Math.max(...expected.barycentric))],
          );
          assertNear(click.position, expected.position, 1e-5, `the position at ${x}, ${y}`);
          assert.deepEqual(click.hitPnt, click.position);
          // The GPU interpolates normals at positions rounded to a fraction of a pixel.
          assertNear(click.normal, expected.normal, 1e-2, "the normal");
        }
        assert.ok(hits >= 8 && hits < pixels.length, `${hits} of ${pixels.length} pixels show the mesh`);
      });
    });
  }
});

/** Removes the normals from a page, so that faces are shaded flat. */
const withoutNormalFiles = (html: string): string => html.replaceAll(/ normal=("[^"]*"|'[^']*')/gi, "");

describe("a surface without normals has the normal of the triangle", () => {
  for (const container of ["sig", "bg"]) {
    (container === "sig" ? test : soakTest)(container, async () => {
      const site = siteOfGenerated("trefoil", "--profile", "classic", "--container", container);
      const patches = decodeSite(site).map(({ positions, triangles, lines, points }) => ({
        positions,
        triangles,
        lines,
        points,
      }));
      await withSite(
        site,
        async (view) => {
          let hits = 0;
          for (const { x, y } of pixels) {
            const expected = expectedAt(site, patches, x, y);
            if (!expected) continue;
            assertNear((await clickAt(view, x, y)).normal, expected.normal, 1e-4, "the normal");
            ++hits;
          }
          assert.ok(hits >= 8);
        },
        withoutNormalFiles,
      );
    });
  }
});

interface ProjectedPoint {
  vertex: number;
  /** Pixel coordinates; centers of pixels are whole numbers. */
  x: number;
  y: number;
  depth: number;
}

function projected(
  patch: PlainPatch,
  vertices: Iterable<number>,
  viewpoint: Parameters<typeof rayThrough>[0],
): ProjectedPoint[] {
  const through = (x: number, y: number): Vec3 => rayThrough(viewpoint, largePictureSize, x, y).direction;
  const corner = through(0, 0);
  const [right, below] = [minus(through(1, 0), corner), minus(through(0, 1), corner)];
  const ahead = through((largePictureSize.width - 1) / 2, (largePictureSize.height - 1) / 2);
  return Array.from(vertices, (vertex) => {
    const towards = minus(vectorAt(patch.positions, vertex), viewpoint.position);
    const depth = dot(towards, ahead);
    const off = minus(towards.map((value) => value / depth) as Vec3, corner);
    return { vertex, depth, x: dot(off, right) / dot(right, right), y: dot(off, below) / dot(below, below) };
  });
}

const containers = { classic: ["--profile", "classic"], bg: ["--container", "bg"], compact: ["--profile", "compact"] };

describe("a point is hit where it is drawn", () => {
  for (const [what, options] of Object.entries(containers)) {
    (what === "compact" ? test : soakTest)(what, async () => {
      const site = siteOfGenerated("points", ...options);
      const [patch] = what === "compact" ? decodeCompactSite(site) : decodeSite(site);
      const points = projected(patch!, patch!.points, referenceSettingsOf(pageOf(site)).viewpoint);
      await withSite(site, async (view) => {
        let hits = 0;
        for (const seed of points.filter((_, i) => i % 250 === 0)) {
          const [x, y] = [Math.round(seed.x), Math.round(seed.y)];
          const expected = pointAt(points, x, y);
          if (expected === "unsure") continue;
          const click = await clickAt(view, x, y);
          assert.equal(click.target, "shape", `at ${x}, ${y}`);
          ++hits;
          assert.deepEqual([click.vertexId, click.triangleId, click.normal], [expected, null, null]);
          assertNear(click.position, vectorAt(patch!.positions, expected), 1e-5, "the position");
        }
        assert.ok(hits >= 8, `${hits} points`);
        assert.equal((await clickAt(view, 5, 5)).target, "imgeo-view");
      });
    });
  }

  /**
   * The nearest point whose square of two pixels covers the center of this pixel; "unsure" near the edge of the square.
   */
  function pointAt(points: ProjectedPoint[], x: number, y: number): number | "unsure" {
    const covering = points.filter((point) => Math.max(Math.abs(point.x - x), Math.abs(point.y - y)) < 1.02);
    const [nearest] = covering.sort((a, b) => a.depth - b.depth);
    return nearest && Math.max(Math.abs(nearest.x - x), Math.abs(nearest.y - y)) < 0.98 ? nearest.vertex : "unsure";
  }
});

describe("a line is hit where it is drawn, and the event has its nearer end", () => {
  for (const [what, options] of Object.entries(containers)) {
    (what === "compact" ? test : soakTest)(what, async () => {
      const site = siteOfGenerated("coil", ...options);
      const [patch] = what === "compact" ? decodeCompactSite(site) : decodeSite(site);
      const { viewpoint } = referenceSettingsOf(pageOf(site));
      const ends = projected(patch!, patch!.lines, viewpoint);
      const lines = Array.from({ length: ends.length / 2 }, (_, i) => [ends[2 * i]!, ends[2 * i + 1]!] as const);
      await withSite(site, async (view) => {
        let hits = 0;
        for (const [a, b] of lines.filter((_, i) => i % 97 === 0)) {
          const [x, y] = [Math.round((a.x + b.x) / 2), Math.round((a.y + b.y) / 2)];
          const click = await clickAt(view, x, y);
          if (click.target !== "shape") continue; // lines are a pixel wide: the midpoint may be in the next pixel
          ++hits;
          const near = lines.filter(
            ([from, to]) => distanceToLine({ x, y }, from, to) < 1 && [from.vertex, to.vertex].includes(click.vertexId),
          );
          assert.ok(near.length > 0, `vertex ${click.vertexId} is the end of no line at ${x}, ${y}`);
          const on = near.some(([from, to]) => {
            const [p, q] = [vectorAt(patch!.positions, from.vertex), vectorAt(patch!.positions, to.vertex)];
            const [nearer, farther] = click.vertexId === from.vertex ? [p, q] : [q, p];
            const [toNearer, toFarther] = [nearer, farther].map((end) => Math.hypot(...minus(click.position!, end)));
            return toNearer! <= toFarther! + 1e-3 && toNearer! + toFarther! < Math.hypot(...minus(p, q)) + 1e-5;
          });
          assert.ok(on, `${click.position!.join(" ")} is not on a line that ends at ${click.vertexId}`);
          assert.deepEqual([click.triangleId, click.normal], [null, null]);
        }
        assert.ok(hits >= 8, `${hits} hits`);
      });
    });
  }

  interface Pixel {
    x: number;
    y: number;
  }

  function distanceToLine(at: Pixel, from: Pixel, to: Pixel): number {
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const along = Math.min(1, Math.max(0, ((at.x - from.x) * dx + (at.y - from.y) * dy) / (dx * dx + dy * dy || 1)));
    return Math.hypot(from.x + along * dx - at.x, from.y + along * dy - at.y);
  }
});

/** The site of the tests of pointer events, a pixel on its shape, and one beside it. */
const site = (): string => siteOfGenerated("trefoil", "--profile", "classic");
const onShape = pixels.find(({ x, y }) => expectedAt(site(), decodeSite(site()), x, y))!;
const nearby = { x: onShape.x + 2, y: onShape.y + 1 };
const offShape = { x: 3, y: largePictureSize.height - 3 };

describe("pointer events", () => {
  test("are dispatched on the shape, bubble, and describe the hit; elsewhere they are dispatched on the view", async () => {
    await withSite(site(), async (view) => {
      const { mouse } = view.page;
      await mouse.move(offShape.x, offShape.y);
      await mouse.move(onShape.x, onShape.y);
      await until("the shape is entered", async () =>
        (await pointerEvents(view, "pointermove")).some(({ target }) => target === "shape"),
      );
      await mouse.move(offShape.x, offShape.y);
      await until("the shape is left", async () =>
        (await pointerEvents(view, "pointerout")).some(({ target }) => target === "shape"),
      );
      const targets = async (type: string): Promise<string[]> =>
        (await pointerEvents(view, type)).map(({ target }) => target);
      assert.deepEqual(await targets("pointerover"), ["imgeo-view", "shape", "imgeo-view"]);
      assert.deepEqual(await targets("mouseover"), ["imgeo-view", "shape", "imgeo-view"]);
      assert.deepEqual(await targets("pointerout"), ["imgeo-view", "shape"]);
      assert.deepEqual(await targets("mousemove"), await targets("pointermove"));
      const [move] = (await pointerEvents(view, "pointermove")).filter(({ target }) => target === "shape");
      assert.equal(move!.triangleId, expectedAt(site(), decodeSite(site()), onShape.x, onShape.y)!.triangle);
    });
  });

  soakTest("can be stopped by a listener on the shape, and enter a group once for all its shapes", async () => {
    const inGroup = (html: string): string =>
      html.replace(/<Shape[\s\S]*<\/Shape>/i, (shape) => `<Group id="all">${shape}</Group>`);
    await withSite(
      site(),
      async (view) => {
        await view.page.evaluate(() => {
          document.querySelector("shape")!.addEventListener("click", (event) => {
            event.stopPropagation();
          });
          document.querySelector("#all")!.addEventListener("pointerenter", ({ target }) => {
            document.title = `entered ${(target as Element).id}`;
          });
        });
        await view.page.mouse.click(onShape.x, onShape.y);
        assert.deepEqual(await pointerEvents(view, "click"), []);
        assert.equal((await pointerEvents(view, "pointerdown")).length, 1);
        await until("the group is entered", async () => (await view.page.title()) === "entered all");
      },
      inGroup,
    );
  });

  test("do not move the camera if pointerdown is prevented, and do not include a click after a drag", async () => {
    await withSite(site(), async (view) => {
      const drag = async (): Promise<void> => {
        await view.page.mouse.move(onShape.x, onShape.y);
        await view.page.mouse.down();
        await view.page.mouse.move(onShape.x + 60, onShape.y + 30, { steps: 4 });
        await view.page.mouse.up();
        await settle(view.page);
      };
      const frames = (): Promise<number> =>
        view.page.evaluate(() => document.querySelector<ImgeoView>("imgeo-view")!.statistics!.frames);
      await view.page.evaluate(() => {
        document.querySelector("shape")!.addEventListener(
          "pointerdown",
          (event) => {
            event.preventDefault();
          },
          { once: true },
        );
      });
      const before = await frames();
      await drag();
      assert.equal(await frames(), before, "the camera has moved");
      assert.equal((await pointerEvents(view, "mousedown")).length, 0, "a prevented pointerdown has no mouse event");
      await view.page.evaluate(() => {
        window.pointerEvents = [];
      });
      await drag();
      assert.ok((await frames()) > before, "the camera has not moved");
      assert.deepEqual(await pointerEvents(view, "click"), []);
    });
  });

  soakTest("ignore shapes that are hidden or not pickable, also after a change", async () => {
    await withSite(site(), async (view) => {
      for (const [name, value] of [
        ["visible", "false"],
        ["isPickable", "false"],
      ] as const) {
        assert.equal((await clickAt(view, onShape.x, onShape.y)).target, "shape");
        await view.page.evaluate(
          ([name, value]) => {
            document.querySelector("shape")!.setAttribute(name, value);
          },
          [name, value] as const,
        );
        await settle(view.page);
        assert.equal((await clickAt(view, onShape.x, onShape.y)).target, "imgeo-view");
        await view.page.evaluate((name) => {
          document.querySelector("shape")!.removeAttribute(name);
        }, name);
        await settle(view.page);
      }
    });
  });

  soakTest("hit shapes that a transform has moved, mirrored and scaled", async () => {
    const moved = (html: string): string =>
      html.replace(
        /<Shape[\s\S]*<\/Shape>/i,
        (shape) =>
          `<Transform scale="-1 0.8 1.3" rotation="0 0 1 0.4" translation="0.2 0.1 0"><Transform rotation="1 0 0 0.3">${shape}</Transform></Transform>`,
      );
    await withSite(
      site(),
      async (view) => {
        let hits = 0;
        for (const { x, y } of pixels) {
          const click = await clickAt(view, x, y);
          if (click.target !== "shape") continue;
          ++hits;
          const { origin, direction } = rayThrough(
            referenceSettingsOf(pageOf(site())).viewpoint,
            largePictureSize,
            x,
            y,
          );
          const along = dot(minus(click.position!, origin), direction) / dot(direction, direction);
          assertNear(
            click.position,
            origin.map((part, i) => part + along * direction[i]!) as Vec3,
            2e-4,
            "the position on the ray",
          );
          assert.ok(dot(click.normal!, direction) < 0.1, "the normal faces the eye");
        }
        assert.ok(hits > 5, `${hits} hits`);
      },
      moved,
    );
  });
});

test("hovering draws no frame and does not wait for the GPU", async () => {
  await withSite(site(), async (view) => {
    await view.page.evaluate(() => {
      const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
      const readPixels = gl.readPixels!;
      gl.readPixels = function (...args) {
        if (typeof args[6] !== "number") document.title = "waited";
        return readPixels.apply(this, args);
      };
    });
    const frames = (): Promise<number> =>
      view.page.evaluate(() => document.querySelector<ImgeoView>("imgeo-view")!.statistics!.frames);
    const before = await frames();
    await view.page.mouse.move(onShape.x, onShape.y);
    await view.page.mouse.move(nearby.x, nearby.y, { steps: 3 });
    await until("the shape gets the event", async () =>
      (await pointerEvents(view, "pointermove")).some(({ target }) => target === "shape"),
    );
    assert.equal(await frames(), before);
    assert.notEqual(await view.page.title(), "waited");
    await view.page.mouse.click(onShape.x, onShape.y);
    assert.equal(await view.page.title(), "waited", "the test would not notice");
  });
});

test("positionAndNormalFromPoint returns the hit at a point of the viewport", async () => {
  await withSite(site(), async (view) => {
    const at = ({
      x,
      y,
    }: {
      x: number;
      y: number;
    }): Promise<{ position: string; normal: string; shape: string } | null> =>
      view.page.evaluate(
        ([x, y]) => {
          const found = document.querySelector<ImgeoView>("imgeo-view")!.positionAndNormalFromPoint(x, y);
          return (
            found && { position: String(found.position), normal: String(found.normal), shape: found.shape.localName }
          );
        },
        [x, y] as const,
      );
    const expected = expectedAt(site(), decodeSite(site()), onShape.x, onShape.y)!;
    const found = await at(onShape);
    assert.equal(found?.shape, "shape");
    assertNear(found.position.split(" ").map(Number) as Vec3, expected.position, 2e-5, "the position");
    assertNear(found.normal.split(" ").map(Number) as Vec3, expected.normal, 1e-2, "the normal");
    assert.equal(await at(offShape), null);
    assert.equal(await at({ x: -5, y: 10 }), null);
  });
});
