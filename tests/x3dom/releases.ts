// Takes pictures of pages in the two releases of X3DOM, from npm, for which imgeo writes pages.

import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { pictureSize, withPage, type View } from "../browser/harness.ts";
import { repository } from "../browser/paths.ts";
import type { Picture } from "../browser/png.ts";

export type Container = "sig" | "bg";

/** The last release that draws SIG, and the newest. */
const folders: Record<Container, string> = { sig: "x3dom-1.7", bg: "x3dom-1.8" };

export function fileOf(container: Container, name: "x3dom.js" | "x3dom.css"): Buffer {
  return readFileSync(join(repository, "node_modules", folders[container], name));
}

/** The hash for an integrity attribute. */
export function hashOf(container: Container, name: "x3dom.js" | "x3dom.css"): string {
  return `sha384-${createHash("sha384").update(fileOf(container, name)).digest("base64")}`;
}

/** Opens `html` as a page of a site written with `--x3dom-url x3dom/`. */
async function withX3dom(
  site: string,
  container: Container,
  html: string,
  bodies: Record<string, Buffer | string>,
  size: { width: number; height: number },
  use: (view: View) => Promise<void>,
): Promise<void> {
  await withPage(
    site,
    {
      path: "page.html",
      size,
      before: requestInOrder,
      server(server) {
        // X3DOM's style sheet contains a data URL, and its code uses eval.
        server.contentPolicy = "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:";
        server.put("/page.html", html);
        server.put("/x3dom/x3dom.js", fileOf(container, "x3dom.js"));
        for (const [path, body] of Object.entries(bodies)) server.put(path, body);
        server.put("/x3dom/x3dom.css", fileOf(container, "x3dom.css"));
      },
    },
    use,
  );
}

/**
 * In the page: lets each XMLHttpRequest begin when the one before has ended. X3DOM counts the files of a
 * `BinaryGeometry` with `normalPerVertex="false"` twice, and never draws it where its normals arrive before its
 * coordinates.
 */
function requestInOrder(): void {
  // eslint-disable-next-line @typescript-eslint/unbound-method -- called with the request as `this`
  const send = XMLHttpRequest.prototype.send;
  let previous = Promise.resolve();
  XMLHttpRequest.prototype.send = function (this: XMLHttpRequest, ...body) {
    previous = previous.then(
      () =>
        new Promise((ended) => {
          this.addEventListener("loadend", () => {
            ended();
          });
          send.apply(this, body);
        }),
    );
  };
}

/** X3DOM's picture of a page after everything has loaded and it has stopped drawing.
 *  `bodies` are files in addition to the site's. */
export async function pictureOf(
  site: string,
  container: Container,
  html: string,
  bodies: Record<string, Buffer | string> = {},
  size = pictureSize,
): Promise<Picture> {
  const pictures: Picture[] = [];
  await withX3dom(site, container, html, bodies, size, async (view) => {
    await loaded(view.page);
    pictures.push(await view.picture());
  });
  const [picture] = pictures;
  if (!picture) throw new Error("no picture was taken");
  return picture;
}

/** X3DOM's own count of pending downloads, and its flag for another frame. */
interface X3domElement extends Element {
  runtime?: { canvas: { doc: { downloadCount: number; needRender: boolean } } };
}

/** X3DOM's node of an element, with meshes when its file has been read. */
interface ExternalShapeElement extends Element {
  _x3domNode?: { meshes?: unknown[] };
}

/** Waits until every image and array has loaded and has been drawn; throws after three minutes. */
async function loaded(page: Page): Promise<void> {
  // X3DOM's count is 0 before it has asked for all files, and an ExternalGeometry sets it to 0 while others load.
  await page.waitForLoadState("networkidle");
  await page.waitForFunction(
    () => {
      const doc = document.querySelector<X3domElement>("x3d")?.runtime?.canvas.doc;
      const hasCounted = doc !== undefined && doc.downloadCount <= 0 && !doc.needRender;
      // An ExternalShape does not count its download.
      const shapes = Array.from(document.querySelectorAll<ExternalShapeElement>("ExternalShape"));
      const isIdle = hasCounted && shapes.every((shape) => shape._x3domNode?.meshes !== undefined);
      const state = window as unknown as { idleFrames?: number; hasAskedForFrame?: boolean };
      state.idleFrames = isIdle ? (state.idleFrames ?? 0) + 1 : 0;
      // The first frame with an ExternalShape compiles its materials; X3DOM does not ask for the next, which draws it.
      if (isIdle && shapes.length > 0 && state.hasAskedForFrame !== true) {
        state.hasAskedForFrame = true;
        state.idleFrames = 0;
        doc.needRender = true;
      }
      return state.idleFrames > 5;
    },
    undefined,
    { timeout: 180_000, polling: "raf" },
  );
}
