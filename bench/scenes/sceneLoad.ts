// Loads a scene once over a slow connection with an empty cache and records the requests and the times of the first
// and the final picture.

import type { Browser } from "playwright-core";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { observe } from "../../tests/browser/pageObserver.ts";
import type { LinkOptions } from "../../tests/browser/networkLink.ts";
import { serve, timeoutMs, viewport } from "../load/measure.ts";
import { ownPolicy } from "../load/pages.ts";

/** A file that the page's document references. */
export interface RequestedFile {
  readonly role: "base" | "patches" | "preview" | "texture";
  /** Names of the shapes that need the file, without trailing numbers, each once. */
  readonly names: readonly string[];
  readonly bytes: number;
}

export interface SceneLoad {
  /** Number of requests, including that of the page. */
  readonly requests: number;
  /** Bytes as sent. */
  readonly bytes: number;
  readonly documentBytes: number;
  readonly runtimeBytes: number;
  /** Time of the first picture in seconds from navigation, and the bytes received until then. */
  readonly firstSeconds: number;
  readonly firstBytes: number;
  readonly finalSeconds: number;
  readonly drawCalls: number;
  /** Counts in the scene; each instance of a shape counts. */
  readonly shapes: number;
  readonly triangles: number;
  /** The scene's files in the order of their requests. */
  readonly requestedFiles: readonly RequestedFile[];
  readonly picture: Buffer;
}

export async function loadScene(browser: Browser, directory: string, connection: LinkOptions): Promise<SceneLoad> {
  const server = await serve({ name: "", directory, contentPolicy: ownPolicy, announcesCompletion: true });
  const context = await browser.newContext({ viewport, reducedMotion: "reduce" });
  try {
    const page = await context.newPage();
    await page.addInitScript(observe);
    await page.addInitScript(() => {
      performance.setResourceTimingBufferSize(10_000);
    });
    const order: string[] = [];
    page.on("request", (request) => order.push(request.url().slice(server.origin.length)));
    server.useLink(connection);
    await page.goto(server.origin, { waitUntil: "commit", timeout: timeoutMs });
    await page.waitForFunction(
      () => window.observed.events.some(({ type, target }) => type === "load" && target === "x3d"),
      undefined,
      { timeout: timeoutMs },
    );
    const measured = await page.evaluate(measure, order);
    return { ...measured, requests: server.requests.length, bytes: server.bytesSent, picture: await page.screenshot() };
  } finally {
    await context.close();
    await server.close();
  }
}

/** Runs in the page; self-contained. */
async function measure(order: readonly string[]): Promise<Omit<SceneLoad, "requests" | "bytes" | "picture">> {
  const x3d = document.querySelector<ViewElement>("x3d")!;
  const timeOf = (type: string): number =>
    window.observed.events.find((event) => event.type === type && event.target === "x3d")?.at ?? NaN;
  const [navigation] = performance.getEntriesByType("navigation") as PerformanceNavigationTiming[];
  const files = performance.getEntriesByType("resource") as PerformanceResourceTiming[];
  const pathOf = (url: string): string => new URL(url).pathname.slice(1);
  const bytesOf = new Map(files.map(({ name, encodedBodySize }) => [pathOf(name), encodedBodySize]));
  const sum = (entries: readonly PerformanceResourceTiming[]): number =>
    entries.reduce((total, { encodedBodySize }) => total + encodedBodySize, 0);

  const fieldOf = (element: Element, name: string): string => element.getAttribute(name) ?? "";
  const defined = new Map(
    Array.from(document.querySelectorAll("[DEF]"), (element) => [fieldOf(element, "DEF"), element]),
  );
  const resolved = (element: Element): Element => defined.get(fieldOf(element, "USE")) ?? element;
  const count = { shapes: 0, triangles: 0 };
  const countIn = (parent: Element): void => {
    for (const child of Array.from(parent.children, resolved)) {
      if (child.localName !== "shape") {
        countIn(child);
        continue;
      }
      count.shapes += 1;
      for (const geometry of Array.from(child.children, resolved)) {
        const patches = geometry.querySelectorAll("geometrypatch");
        for (const patch of patches.length > 0 ? Array.from(patches) : [geometry]) {
          for (const corners of fieldOf(patch, "vertexCount").split(" ")) count.triangles += Number(corners) / 3;
        }
      }
    }
  };
  countIn(x3d.querySelector("scene")!);

  /** DEF of a texture's Appearance, or the nearest DEF around a geometry's Shape. */
  const nameOf = (element: Element): string => {
    const shape = element.closest("shape");
    const named = element.closest("appearance[DEF]") ?? shape?.closest("[DEF]:not(shape)") ?? shape ?? element;
    return fieldOf(named, "DEF").replaceAll(/[-_.]?\d+$/g, "") || element.localName;
  };
  const roleAttributes = { base: ["base"], patches: ["data"], preview: ["preview"], texture: ["url"] } as const;
  const requestedFiles = order.flatMap((path) => {
    for (const [role, attributes] of Object.entries(roleAttributes)) {
      const users = attributes.flatMap((attribute) => Array.from(x3d.querySelectorAll(`[${attribute}*="${path}"]`)));
      if (path !== "" && users.length > 0) {
        return [
          {
            role: role as keyof typeof roleAttributes,
            names: [...new Set(users.map(nameOf))],
            bytes: bytesOf.get(path) ?? 0,
          },
        ];
      }
    }
    return [];
  });
  await x3d.toBlob(); // draws a frame
  const statistics = document.querySelector<ViewElement>("imgeo-view")?.statistics;
  const firstMs = timeOf("first-image");
  return {
    documentBytes: navigation?.encodedBodySize ?? 0,
    runtimeBytes: sum(files.filter(({ name }) => pathOf(name).startsWith("runtime/"))),
    firstSeconds: firstMs / 1000,
    firstBytes: (navigation?.encodedBodySize ?? 0) + sum(files.filter(({ responseEnd }) => responseEnd <= firstMs)),
    finalSeconds: timeOf("load") / 1000,
    drawCalls: statistics?.drawCalls ?? 0,
    ...count,
    requestedFiles,
  };
}
