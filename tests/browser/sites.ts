// Converts meshes into sites with the tool under test.

import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import {
  coil,
  cube,
  pointSpiral,
  sphere,
  trefoil,
  withColors,
  withNumbers,
  withoutNormals,
  writePly,
  type PlainMesh,
} from "./meshes.ts";
import { converter, outputDirectory } from "./paths.ts";

const generators = {
  trefoil: () => trefoil(),
  /** More vertices than 16-bit indices can address. */
  "trefoil-large": () => trefoil(2000, 34),
  "trefoil-colors": () => withColors(trefoil()),
  "trefoil-numbers": () => withNumbers(trefoil()),
  "trefoil-plain": () => withoutNormals(trefoil()),
  sphere: () => sphere(),
  "sphere-large": () => sphere(96),
  "sphere-small": () => sphere(4),
  "sphere-numbers": () => withNumbers(sphere(4)),
  points: () => pointSpiral(),
  coil: () => coil(),
  cube: () => cube(),
} satisfies Record<string, () => PlainMesh>;

export type GeneratedMesh = keyof typeof generators;

/** The PLY file of a generated mesh. */
export function meshFile(name: GeneratedMesh): string {
  const path = join(outputDirectory, `${name}.ply`);
  mkdirSync(outputDirectory, { recursive: true });
  writeFileSync(path, writePly(generators[name]()));
  return path;
}

/** A viewpoint that convert adds beside the first one. */
const namedViewpoint = /<viewpoint description="(?:Front|Left|Back|Right|Top)"[\s\S]*?<\/viewpoint>\s*/gi;

const converted = new Map<string, string>();

/**
 * The directory of the site that `imgeo convert INPUT OPTIONS` makes, with the first viewpoint only: a menu of several
 * would cover a corner of every picture. PLY files have y up. Converts once a run for each set of arguments.
 */
export function siteOf(input: string, ...options: string[]): string {
  return siteOfFiles([input], ...options);
}

/** The same of the frames of a sequence. */
export function siteOfFrames(name: string, frames: readonly PlainMesh[], ...options: string[]): string {
  mkdirSync(outputDirectory, { recursive: true });
  const files = frames.map((mesh, frame) => {
    const path = join(outputDirectory, `${name}-${frame}.ply`);
    writeFileSync(path, writePly(mesh));
    return path;
  });
  return siteOfFiles(files, ...options);
}

function siteOfFiles(inputs: readonly string[], ...options: string[]): string {
  const [input = ""] = inputs;
  const name = [basename(input).replace(/\..*/, ""), ...options].join("").replaceAll(/[^\w]+/g, "-");
  const known = converted.get(name);
  if (known !== undefined) return known;
  if (!existsSync(converter)) throw new Error(`${converter} is missing: run 'make build' first`);
  const directory = join(outputDirectory, "sites", name);
  rmSync(directory, { recursive: true, force: true });
  mkdirSync(join(outputDirectory, "sites"), { recursive: true });
  const axes = input.endsWith(".ply") && !options.includes("--up") ? ["--up", "y"] : [];
  execFileSync(converter, ["convert", ...inputs, "-o", directory, ...options, ...axes], {
    stdio: ["ignore", "ignore", "inherit"],
  });
  const page = join(directory, "index.html");
  writeFileSync(page, readFileSync(page, "utf8").replaceAll(namedViewpoint, ""));
  converted.set(name, directory);
  return directory;
}

export function siteOfGenerated(name: GeneratedMesh, ...options: string[]): string {
  return siteOf(meshFile(name), ...options);
}

/** The files of reliefs that this run has made. */
const reliefs = new Set<string>();

/** The site of a closed surface of about so many triangles, which `imgeo sample relief` makes. */
export function siteOfRelief(triangles: number, ...options: string[]): string {
  const path = join(outputDirectory, `relief-${triangles}.ply`);
  mkdirSync(outputDirectory, { recursive: true });
  if (!reliefs.has(path))
    execFileSync(converter, ["sample", "relief", "--triangles", `${triangles}`, "-o", path], { stdio: "ignore" });
  reliefs.add(path);
  return siteOf(path, "--no-pictures", ...options);
}

export function pageOf(site: string): string {
  return readFileSync(join(site, "index.html"), "utf8");
}

/** A copy of a site with a changed page. */
export function variantOf(site: string, name: string, change: (page: string) => string): string {
  const directory = `${site}-${name}`;
  rmSync(directory, { recursive: true, force: true });
  cpSync(site, directory, { recursive: true });
  writeFileSync(join(directory, "index.html"), change(pageOf(site)));
  return directory;
}

/** The text of a page's only Shape. */
export function shapeIn(page: string): string {
  const shape = /<Shape[\s\S]*<\/Shape>/i.exec(page)?.[0];
  if (shape === undefined) throw new Error("the page has no Shape");
  return shape;
}

/** The page with its only Shape replaced. */
export function withShapes(page: string, change: (shape: string) => string): string {
  return page.replace(shapeIn(page), () => change(shapeIn(page)));
}
