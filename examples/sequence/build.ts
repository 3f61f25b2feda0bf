// Builds the page in build/sequence, for any server: around the site of a recorded sequence, or of a cloth.
//
//   node examples/sequence/build.ts [SITE [OUTPUT]]

import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { sequencePage } from "./page.ts";

const here = import.meta.dirname;
const repository = join(here, "../..");
const [site, output = join(repository, "build/sequence")] = process.argv.slice(2);

/** Converts the frames of a cloth, as `imgeo convert frames-*.ply` does those of any simulation. */
function clothSite(): string {
  const folder = mkdtempSync(join(tmpdir(), "imgeo-"));
  const imgeo = (...words: string[]): void =>
    void execFileSync(join(repository, "build/imgeo"), words, { stdio: "ignore" });
  imgeo("sample", "cloth", "--frames", "240", "--grid", "96", "-o", join(folder, "frames"));
  imgeo("convert", join(folder, "frames/cloth-*.ply"), "-o", join(folder, "site"));
  return join(folder, "site");
}

const source = site ?? clothSite();
rmSync(output, { recursive: true, force: true });
cpSync(source, output, { recursive: true });
for (const file of ["scrub.css", "scrub.js"]) cpSync(join(here, file), join(output, file));
writeFileSync(
  join(output, "index.html"),
  sequencePage(readFileSync(join(source, "scene.x3d"), "utf8"), "A recorded cloth"),
);
if (site === undefined) rmSync(join(source, ".."), { recursive: true });
