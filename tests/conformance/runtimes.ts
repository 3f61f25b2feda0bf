// The three runtimes that display a document: imgeo, X_ITE and X3DOM, each as a page that a server serves with the
// document.

import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { bundleRuntime } from "../../web/bundle.ts";
import { repository } from "../browser/paths.ts";
import type { TestServer } from "../browser/server.ts";

export const runtimes = ["imgeo", "X_ITE", "X3DOM"] as const;
export type Runtime = (typeof runtimes)[number];

/** In documents with NURBS, prototypes or skins: imgeo displays them as `convert` has written them. */
export const needsConversion = /<Nurbs\w*(Surface|Curve)\b|<ProtoDeclare\b|containerField="skinCoord"/;

/** Size of a picture in CSS pixels. */
export const size = { width: 320, height: 240 };

const fill = "margin: 0; border: 0; padding: 0; display: block; width: 100vw; height: 100vh";

/** Puts the files that the pages need on the server. */
export async function serveRuntimes(server: TestServer): Promise<void> {
  server.contentPolicy = "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:";
  server.put("/imgeo.js", Buffer.from(await bundleRuntime()));
  const packageFile = (path: string): Buffer => readFileSync(join(repository, "node_modules", path));
  server.put("/x_ite.js", packageFile("x_ite/dist/x_ite.min.js"));
  const fonts = readdirSync(join(repository, "node_modules/x_ite/dist/assets/fonts"), {
    recursive: true,
    encoding: "utf8",
  })
    .filter((file) => file.includes("."))
    .map((font) => `assets/fonts/${font}`);
  for (const file of [
    "x_ite.css",
    "assets/lib/mikktspace_bg.wasm",
    ...["CADGeometry", "EventUtilities", "Geometry2D", "HAnim", "NURBS", "Text"].map(
      (name) => `assets/components/${name}Component.js`,
    ),
    "assets/lib/woff2_decoder.js",
    ...fonts,
  ])
    server.put(`/${file}`, packageFile(`x_ite/dist/${file}`));
  server.put("/x3dom.js", packageFile("x3dom-1.8/x3dom.js"));
  server.put("/x3dom.css", packageFile("x3dom-1.8/x3dom.css"));
}

/** The page in which a runtime displays the document at `path`. */
export function pageOf(runtime: Runtime, path: string, document: string): string {
  const scene = asHtml(document);
  switch (runtime) {
    case "imgeo":
      return html(`<script type="module" src="/imgeo.js"></script>`, scene.replace("<X3D", `<X3D style="${fill}"`));
    case "X_ITE":
      return html(
        `<script src="/x_ite.js"></script>`,
        `<x3d-canvas src="${path}" style="${fill}" splashScreen="false" notifications="false" contextMenu="false" update="auto"></x3d-canvas>`,
      );
    case "X3DOM":
      return html(
        `<script src="/x3dom.js"></script><link rel="stylesheet" href="/x3dom.css">`,
        scene
          .replace(
            "<X3D",
            `<X3D style="${fill}" width="${size.width}px" height="${size.height}px" showStat="false" showLog="false"`,
          )
          // By default X3DOM adds linear light, which X3D 4 requires only of PhysicalMaterial.
          .replace("<Scene>", '<Scene><Environment gammaCorrectionDefault="none"></Environment>'),
      );
  }
}

function html(head: string, body: string): string {
  return `<!doctype html><html><head><meta charset="utf-8"><style>html, body { margin: 0; overflow: hidden }</style>${head}</head><body>${body}</body></html>`;
}

/** Converts XML to HTML, in which X3D elements need end tags. */
function asHtml(document: string): string {
  return document.replace(/<\?xml[^>]*\?>\s*/, "").replace(/<(\w+)([^<>]*?)\/>/g, "<$1$2></$1>");
}
