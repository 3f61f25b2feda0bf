// The pages that are drawn in all engines: a site of each container, levels of detail, points, a hall of many shapes, a
// recorded simulation as frames and as a video, textures with alpha; and the documents of tests/conformance, each with
// nodes of X3D.

import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { moments } from "../conformance/moments.ts";
import { needsConversion, pageOf } from "../conformance/runtimes.ts";
import { alphaPage } from "../browser/alphaScene.ts";
import { converter, outputDirectory, repository } from "../browser/paths.ts";
import { startServer, type TestServer } from "../browser/server.ts";
import { siteOf, siteOfGenerated, siteOfRelief } from "../browser/sites.ts";
import { bundleRuntime, bundleWorker } from "../../web/bundle.ts";

export interface ComparedPage {
  readonly name: string;
  /** Relative to the server's origin. */
  readonly path: string;
  /** Sets the page to a moment, after it is complete: an expression. */
  readonly change?: string;
}

export interface ComparedPages {
  readonly server: TestServer;
  readonly pages: readonly ComparedPage[];
}

function sampleOf(name: string, ...options: string[]): string {
  const path = join(outputDirectory, name);
  mkdirSync(outputDirectory, { recursive: true });
  rmSync(path, { recursive: true, force: true });
  execFileSync(converter, ["sample", ...options, "-o", path], { stdio: "ignore" });
  return path;
}

/** Images of normals have four channels. */
const classicWithAlpha = ["--profile", "classic", "--normals", "spherical", "--normal-bits", "16"];

/** The sites by the names of their pages. */
function sites(): Readonly<Record<string, string>> {
  const frames = sampleOf("engine-cloth", "cloth", "--frames", "30", "--grid", "32");
  const cloth = join(frames, "cloth-*.ply");
  return {
    compact: siteOfGenerated("trefoil-large"),
    classic: siteOfGenerated("trefoil-large", "--profile", "classic"),
    BG: siteOfGenerated("trefoil-large", "--container", "bg"),
    "webp of classic": siteOfGenerated("trefoil-colors", "--profile", "classic", "--images", "webp"),
    "alpha of classic": siteOfGenerated("trefoil-large", ...classicWithAlpha),
    "webp of classic with alpha": siteOfGenerated("trefoil-large", ...classicWithAlpha, "--images", "webp"),
    "geometry image": siteOfGenerated("sphere", "--as", "geometry-image"),
    points: siteOfGenerated("points"),
    levels: siteOfRelief(200_000, "--levels", "always"),
    hall: siteOf(sampleOf("engine-hall.glb", "hall", "--seats", "30"), "--no-pictures"),
    sequence: siteOf(cloth, "--no-pictures"),
    video: siteOf(cloth, "--no-pictures", "--as", "video"),
    // Browsers differ in how they convert colours of other gammas.
    "alpha of textures": alphaPage("engine-alpha", ["gamma.png"]),
  };
}

export async function servePages(): Promise<ComparedPages> {
  const server = await startServer(join(outputDirectory, "sites"));
  server.contentPolicy =
    "default-src 'self' 'unsafe-inline'; script-src 'self' 'wasm-unsafe-eval'; img-src 'self' data:";
  server.put("/imgeo.js", Buffer.from(await bundleRuntime()));
  server.put("/imgeo-worker.js", Buffer.from(await bundleWorker()));
  const pages: ComparedPage[] = Object.entries(sites()).map(([name, site]) => ({
    name,
    path: `${site.slice(join(outputDirectory, "sites").length + 1)}/`,
    ...(/^(sequence|video)$/.test(name)
      ? { change: `document.querySelector("x3d").setAttribute("sequence-time", "0.5")` }
      : {}),
  }));
  const conformance = join(repository, "tests/conformance");
  for (const file of readdirSync(conformance, { recursive: true, encoding: "utf8" }))
    if (/\.(png|jpg|gif|mp4|webm|ttf|mpg|bin|glb|gltf|wrl)$/.test(file))
      server.put(`/${file}`, readFileSync(join(conformance, file)));
  for (const file of readdirSync(join(conformance, "nodes")).sort()) {
    const name = file.replace(/\.x3d$/, "");
    const text = readFileSync(join(conformance, "nodes", file), "utf8");
    server.put(`/nodes/${file}`, text);
    if (name === file || needsConversion.test(text)) continue;
    server.put(`/nodes/${name}.html`, pageOf("imgeo", `/nodes/${file}`, text));
    const fraction = moments[name];
    pages.push({
      name,
      path: `nodes/${name}.html`,
      ...(fraction === undefined
        ? {}
        : { change: `document.querySelector('[DEF="clock"]').setAttribute("set_fraction", "${fraction}")` }),
    });
  }
  return { server, pages };
}
