// The sites of the examples with small models: the hall (`make hall`) and the museum (`make museum`).

import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import { walkPage } from "../../examples/hall/page.ts";
import { museumPage } from "../../examples/museum/page.ts";
import { converter, outputDirectory, repository } from "./paths.ts";
import { siteOf, siteOfGenerated, variantOf } from "./sites.ts";

/** The hall with this many rows of seats, without shapes that are slow to draw, its seats included. */
export function hallSite(rows: number): string {
  mkdirSync(outputDirectory, { recursive: true });
  const file = join(outputDirectory, "hall.glb");
  execFileSync(converter, ["sample", "hall", "--seats", String(rows * 40), "-o", file], {
    stdio: ["ignore", "ignore", "inherit"],
  });
  const site = variantOf(siteOf(file), "walk", (page) =>
    walkPage(page, "A hall", "Walk.")
      .replaceAll(/(DEF="(?:row\d+|trusses|columns)")/g, '$1 visible="false"')
      .replace('speed="3"', 'speed="5"'),
  );
  cpSync(join(repository, "examples/hall/hall.css"), join(site, "hall.css"));
  return site;
}

/** A ball with a note on its front and one on its back. */
export function museumSite(): string {
  const notes = [
    { name: "Front", text: "Its face.", position: [0, 0, 1.2], normal: [0, 0, 1] },
    { name: "Back", text: "Its other side.", position: [0, 0, -1.2], normal: [0, 0, -1] },
  ] as const;
  const site = variantOf(siteOfGenerated("sphere"), "museum", (page) => museumPage(page, "A ball", "Turn it.", notes));
  cpSync(join(repository, "examples/museum/museum.css"), join(site, "museum.css"));
  return site;
}
