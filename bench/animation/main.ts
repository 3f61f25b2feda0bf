// Bytes of animated glTF files as sites and as gltfpack writes them, with the same keys: gltfpack's own resampling is
// off (-af 0), and the tracks that it finds constant are kept (-ac). Its values have 16 bits for translations and scales
// and 12 for rotations, or as many as it can write; sites have 7 decimal digits. The bytes of an animation are those of the whole
// file without those of the same file without its animations. Prints Markdown tables.
//
//   scripts/bench animation
//
// The samples are those of scripts/gltf --animated, from Debian's assimp-testmodels, or from the folder IMGEO_PACKAGES
// into which `dpkg-deb --extract` has unpacked the package.

import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { converter, repository } from "../../tests/browser/paths.ts";
import { animatedSamples } from "../../tests/gltf/animatedSamples.ts";

const models = join(process.env.IMGEO_PACKAGES ?? "/", "usr/share/assimp/models");
const output = join(repository, "build/bench-animation");

interface Accessor {
  count: number;
}
interface Gltf {
  buffers?: { uri?: string }[];
  accessors?: Accessor[];
  animations?: undefined | { channels: unknown[]; samplers: { input: number; interpolation?: string }[] }[];
}

const magic = 0x46546c67; // "glTF"

function readGltf(file: string): { gltf: Gltf; rest: Buffer } {
  const bytes = readFileSync(file);
  if (bytes.readUInt32LE(0) !== magic) return { gltf: JSON.parse(bytes.toString("utf8")) as Gltf, rest: Buffer.of() };
  const end = 20 + bytes.readUInt32LE(12);
  return { gltf: JSON.parse(bytes.toString("utf8", 20, end)) as Gltf, rest: bytes.subarray(end) };
}

/** Writes a glTF document with the binary chunk of a GLB file, if it had one. */
function writeGltf(file: string, gltf: Gltf, rest: Buffer): void {
  if (rest.length === 0) {
    writeFileSync(file, JSON.stringify(gltf));
    return;
  }
  let json = JSON.stringify(gltf);
  while (Buffer.byteLength(json) % 4 !== 0) json += " ";
  const text = Buffer.from(json);
  const header = Buffer.alloc(20);
  const words = [magic, 2, 20 + text.length + rest.length, text.length, 0x4e4f534a]; // "JSON"
  words.forEach((word, i) => header.writeUInt32LE(word, 4 * i));
  writeFileSync(file, Buffer.concat([header, text, rest]));
}

function run(program: string, ...args: string[]): void {
  execFileSync(program, args, { stdio: ["ignore", "ignore", "inherit"] });
}

/** A glTF or GLB file of a sample in a folder of its own. */
function fileOf(sample: string): string {
  const folder = join(output, basename(sample));
  mkdirSync(folder, { recursive: true });
  const path = join(models, sample);
  if (path.endsWith(".gltf")) {
    for (const { uri } of readGltf(path).gltf.buffers ?? [])
      if (uri !== undefined && !uri.startsWith("data:")) copyFileSync(join(dirname(path), uri), join(folder, uri));
    copyFileSync(path, join(folder, "animated.gltf"));
    return join(folder, "animated.gltf");
  }
  const site = join(folder, "source");
  run(converter, "convert", path, "-o", site, "--force", "--container", "bg", "--coord-type", "float32");
  run(converter, "export", site, "-o", join(folder, "animated.glb"));
  return join(folder, "animated.glb");
}

/** The keys of all samplers together. */
function keysOf(gltf: Gltf): number {
  return (gltf.animations ?? [])
    .flatMap(({ samplers }) => samplers)
    .reduce((sum, { input }) => sum + (gltf.accessors?.[input]?.count ?? 0), 0);
}

interface Sizes {
  raw: number;
  gzip: number;
  brotli: number;
}

/** Files as a host sends them: compressed, unless that makes one larger. */
function sizesOf(files: readonly string[]): Sizes {
  const sum = { raw: 0, gzip: 0, brotli: 0 };
  for (const file of files) {
    const bytes = readFileSync(file);
    sum.raw += bytes.length;
    sum.gzip += Math.min(bytes.length, gzipSync(bytes, { level: 9 }).length);
    sum.brotli += Math.min(bytes.length, brotliCompressSync(bytes).length);
  }
  return sum;
}

/** The document and the containers of a site. */
function siteOf(file: string): Sizes {
  const site = `${file}-site`;
  run(converter, "convert", file, "-o", site, "--force", "--effort", "9");
  run(converter, "verify", site, file);
  const geometry = join(site, "geometry");
  return sizesOf([join(site, "scene.x3d"), ...readdirSync(geometry).map((name) => join(geometry, name))]);
}

const finest = ["-at", "24", "-ar", "16", "-as", "24"];

function packed(file: string, ...precision: string[]): Sizes & { keys: number } {
  const glb = `${file}-packed.glb`;
  const options = ["-cz", "-vp", "16", "-vn", "8", "-kv", "-kn", "-af", "0", "-ac", ...precision];
  run(process.execPath, join(repository, "node_modules/gltfpack/cli.js"), "-i", file, "-o", glb, ...options);
  return { ...sizesOf([glb]), keys: keysOf(readGltf(glb).gltf) };
}

const grouped = (count: number): string => count.toLocaleString("en-US");
const cell = (whole: Sizes, without?: Sizes): string =>
  [whole.raw - (without?.raw ?? 0), whole.gzip - (without?.gzip ?? 0), whole.brotli - (without?.brotli ?? 0)]
    .map(grouped)
    .join(" / ");

rmSync(output, { recursive: true, force: true });
const animations: string[] = [];
const files: string[] = [];
for (const sample of animatedSamples) {
  const file = fileOf(sample);
  const { gltf, rest } = readGltf(file);
  const still = file.replace("animated.", "still.");
  writeGltf(still, { ...gltf, animations: undefined }, rest);
  const site = { moving: siteOf(file), still: siteOf(still) };
  const pack = { moving: packed(file), finest: packed(file, ...finest), still: packed(still) };
  const name = `\`${basename(sample)}\``;
  const keys = `${grouped(keysOf(gltf))} | ${grouped(pack.moving.keys)}`;
  const cells = [site.moving, pack.moving, pack.finest].map((sizes, i) =>
    cell(sizes, i === 0 ? site.still : pack.still),
  );
  const ratio = (site.moving.brotli - site.still.brotli) / (pack.moving.brotli - pack.still.brotli);
  animations.push(`| ${name} | ${keys} | ${cells.join(" | ")} | ${ratio.toFixed(2)} |`);
  files.push(`| ${name} | ${cell(site.moving)} | ${cell(pack.moving)} |`);
}
console.log(
  "| bytes of the animation: as they are / gzip / brotli | keys | gltfpack's | imgeo | gltfpack | finest | ratio |",
);
console.log(`|---|--:|--:|--:|--:|--:|--:|\n${animations.join("\n")}\n`);
console.log("| bytes of document and geometry, or GLB | imgeo | gltfpack |");
console.log(`|---|--:|--:|\n${files.join("\n")}`);
