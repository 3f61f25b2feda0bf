// Pages that load the same mesh in different formats, as users of each format write them: with preload hints, a camera
// that frames the model, and no other content.

import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";
import type { PlainMesh } from "../../tests/browser/meshes.ts";
import { repository } from "../../tests/browser/paths.ts";
import { pageOf } from "../../tests/browser/sites.ts";
import { meshOf, type Container, type Model } from "./models.ts";

export interface BenchPage {
  name: string;
  directory: string;
  contentPolicy: string;
  /** The page sends an event when the model is complete; other pages are complete with their first picture. */
  announcesCompletion: boolean;
}

/** That of `imgeo serve`: workers may compile WebAssembly. */
export const ownPolicy = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'";
/** The policy that X3DOM (eval, data URLs) and decoders in workers (wasm, blobs) need. */
export const laxPolicy = "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:";

export function sitePage(model: Model, container: Container): BenchPage {
  return { name: container, directory: model.sites[container], contentPolicy: ownPolicy, announcesCompletion: true };
}

/**
 * The mesh as text in the page, displayed by the newest X3DOM. Six digits hold more than 16 bits, three more than 8.
 */
export function inlinePage(model: Model, directory: string): BenchPage {
  mkdirSync(directory, { recursive: true });
  for (const file of ["x3dom.js", "x3dom.css"])
    cpSync(join(repository, "node_modules/x3dom-1.8", file), join(directory, file));
  const html = pageOf(model.sites["SIG classic"]);
  const viewpoint = /<Viewpoint[^>]*>/.exec(html)?.[0] ?? "";
  const lights = html.match(/<DirectionalLight[^>]*><\/DirectionalLight>/g)?.join("") ?? "";
  writeFileSync(
    join(directory, "index.html"),
    `<!doctype html><html><head><meta charset="utf-8"><title>${model.name}</title>
<link rel="stylesheet" href="x3dom.css"><script src="x3dom.js"></script>
<style>html, body { margin: 0; height: 100% } x3d { width: 100%; height: 100%; border: 0 }</style></head><body>
<X3D><Scene>${viewpoint}</Viewpoint>${lights}<Shape><Appearance><Material></Material></Appearance>
${inlineMesh(meshOf(model))}</Shape></Scene></X3D></body></html>`,
  );
  return { name: "inline X3D", directory, contentPolicy: laxPolicy, announcesCompletion: false };
}

function inlineMesh({ positions, normals, triangles }: PlainMesh): string {
  const words = (values: Float32Array, digits: number): string =>
    Array.from(values, (value) => String(Number(value.toPrecision(digits)))).join(" ");
  return (
    `<IndexedTriangleSet index="${triangles.join(" ")}"><Coordinate point="${words(positions, 6)}"></Coordinate>` +
    (normals ? `<Normal vector="${words(normals, 3)}"></Normal>` : "") +
    "</IndexedTriangleSet>"
  );
}

/** three.js with its DRACOLoader, as its examples use it. 16-bit positions, 8-bit normals, Draco's default level. */
export async function dracoPage(model: Model, directory: string): Promise<BenchPage> {
  mkdirSync(directory, { recursive: true });
  execFileSync(
    "draco_encoder",
    ["-i", model.ply, "-o", join(directory, "mesh.drc"), "-qp", "16", "-qn", "8", "-cl", "7"],
    { stdio: ["ignore", "ignore", "inherit"] },
  );
  cpSync(join(repository, "node_modules/three/examples/jsm/libs/draco"), join(directory, "draco"), { recursive: true });
  const preloads = ["mesh.drc", "draco/draco_wasm_wrapper.js", "draco/draco_decoder.wasm"];
  return threePage("three.js + Draco", "bench/load/pages/draco.ts", preloads, directory);
}

/** three.js with the glTF that gltfpack makes: 16-bit positions, 8-bit normals, meshopt's stronger compression. */
export async function meshoptPage(model: Model, directory: string): Promise<BenchPage> {
  mkdirSync(directory, { recursive: true });
  gltfpack(model, join(directory, "mesh.glb"));
  return threePage("three.js + meshopt", "bench/load/pages/meshopt.ts", ["mesh.glb"], directory);
}

/** The same, after a version simplified to 2 % of the triangles, which is displayed as soon as it has arrived. */
export async function lod2Page(model: Model, directory: string): Promise<BenchPage> {
  mkdirSync(directory, { recursive: true });
  gltfpack(model, join(directory, "mesh.glb"));
  gltfpack(model, join(directory, "coarse.glb"), "-si", "0.02", "-sa");
  return threePage("three.js + meshopt, 2 % first", "bench/load/pages/lod2.ts", ["coarse.glb"], directory);
}

function gltfpack(model: Model, output: string, ...options: string[]): void {
  const words = ["-i", model.glb, "-o", output, "-vp", "16", "-vn", "8", "-cc", ...options];
  execFileSync(process.execPath, [join(repository, "node_modules/gltfpack/cli.js"), ...words], {
    stdio: ["ignore", "ignore", "inherit"],
  });
}

/**
 * A page with a program of three.js as its users write it, with preload hints. `script`: a path in the repository;
 * `head`: further elements, before it.
 */
export async function threePage(
  name: string,
  script: string,
  preloads: readonly string[],
  directory: string,
  head = "",
): Promise<BenchPage> {
  await build({
    entryPoints: [join(repository, script)],
    outfile: join(directory, "page.js"),
    bundle: true,
    format: "esm",
    target: "es2022",
    minify: true,
    logLevel: "warning",
  });
  const hints = preloads.map((url) => `<link rel="preload" as="fetch" crossorigin="anonymous" href="${url}">`);
  writeFileSync(
    join(directory, "index.html"),
    `<!doctype html><html><head><meta charset="utf-8"><title>${name}</title>
<link rel="modulepreload" href="page.js">${hints.join("")}${head}<script type="module" src="page.js"></script>
<style>html, body { margin: 0; height: 100% } canvas { display: block }</style></head><body></body></html>`,
  );
  return { name, directory, contentPolicy: laxPolicy, announcesCompletion: true };
}
