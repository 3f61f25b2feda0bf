// Draws each document of nodes/ in imgeo's runtime, in X_ITE and in X3DOM, in the same browser, and compares the
// pictures. imgeo draws documents with NURBS, prototypes or skins as `build/imgeo convert` has written them, and the VRML 1.0
// file of the same name where there is one, a format that the other runtimes do not read. Writes docs/conformance.md
// and its picture; fails if imgeo differs from one of them and explanations.ts does not explain it.
//
//   scripts/conformance [NAME…]      only those documents; pictures only in build/conformance
//   scripts/conformance --check      all of them, without writing into docs/

import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { launchChromium } from "../browser/chromium.ts";
import { difference } from "../browser/compare.ts";
import { repository } from "../browser/paths.ts";
import { decodePng, encodePng } from "../browser/png.ts";
import { startServer, type TestServer } from "../browser/server.ts";
import { stillPicture } from "../browser/stillPicture.ts";
import { explanations, maxEqualMean } from "./explanations.ts";
import { goTo, moments } from "./moments.ts";
import type { Runtime } from "./runtimes.ts";
import { needsConversion, pageOf, runtimes, serveRuntimes, size } from "./runtimes.ts";
import type { Row } from "./contactSheet.ts";
import { contactSheet } from "./contactSheet.ts";

const here = import.meta.dirname;
const output = join(repository, "build/conformance");
const table = join(repository, "docs/conformance.md");
const picture = join(repository, "docs/images/conformance.png");

/** Converts a document, puts the files of its site into a folder of the server, and returns the converted document. */
function convert(server: TestServer, path: string, folder: string): string {
  const site = mkdtempSync(join(tmpdir(), "imgeo-conformance-"));
  try {
    execFileSync(
      join(repository, "build/imgeo"),
      ["convert", path, "-o", site, "--force", "--container", "bg", "--coord-type", "float32"],
      { stdio: "ignore" },
    );
    for (const file of readdirSync(site, { recursive: true, encoding: "utf8", withFileTypes: true }))
      if (file.isFile()) {
        const absolute = join(file.parentPath, file.name);
        server.put(`/${folder}${absolute.slice(site.length + 1)}`, readFileSync(absolute));
      }
    // Pictures outside of the document's folder are left where they are.
    return readFileSync(join(site, "scene.x3d"), "utf8").replaceAll('"../', '"/');
  } finally {
    rmSync(site, { recursive: true });
  }
}

async function show(page: Page, server: TestServer, runtime: Runtime, name: string): Promise<Buffer> {
  const path = join(here, "nodes", `${name}.x3d`);
  const source = readFileSync(path, "utf8");
  const vrml = join(here, "nodes", `${name}.wrl`);
  const isConverted = runtime === "imgeo" && (existsSync(vrml) || needsConversion.test(source));
  const folder = isConverted ? `converted/${name}/` : "nodes/";
  const scene = isConverted ? convert(server, existsSync(vrml) ? vrml : path, folder) : source;
  const address = `${folder}${runtime}-${name}.html`;
  server.put(`/${address}`, pageOf(runtime, `/nodes/${name}.x3d`, scene));
  await page.goto(server.origin + address);
  if (runtime === "imgeo")
    await page.waitForFunction(
      () => (document.querySelector("x3d") as { complete?: unknown } | null)?.complete !== undefined,
    );
  if (isConverted)
    await page.evaluate(() => (document.querySelector("x3d") as { complete?: unknown } | null)?.complete);
  const moment = moments[name];
  if (moment === undefined) return stillPicture(() => page.screenshot());
  await stillPicture(() => page.screenshot());
  await goTo(page, runtime, moment);
  return stillPicture(() => page.screenshot());
}

async function showAll(browser: Browser, names: readonly string[]): Promise<Row[]> {
  const server = await startServer(here);
  await serveRuntimes(server);
  const rows: Row[] = [];
  try {
    for (const name of names) {
      const pictures: Partial<Record<Runtime, Buffer>> = {};
      for (const runtime of runtimes) {
        const page = await browser.newPage({ viewport: size, reducedMotion: "reduce" });
        page.setDefaultTimeout(120_000); // a machine that does something else must not lose the pictures before
        pictures[runtime] = await show(page, server, runtime, name);
        await page.close();
        writeFileSync(join(output, `${name}-${runtime}.png`), encodePng(decodePng(pictures[runtime])));
      }
      rows.push({ name, pictures: pictures as Row["pictures"] });
      process.stderr.write(`${name}\n`);
    }
  } finally {
    await server.close();
  }
  return rows;
}

/** Mean difference of a colour channel, 0 … 255, between our picture and another's. */
function meanTo(row: Row, other: Runtime): number {
  return difference(decodePng(row.pictures.imgeo), decodePng(row.pictures[other])).mean;
}

function lineOf(row: Row): { text: string; isExplained: boolean } {
  const means = runtimes.slice(1).map((other) => meanTo(row, other));
  const why = explanations[row.name] ?? "";
  return {
    text: `| ${row.name} | ${means.map((mean) => mean.toFixed(2)).join(" | ")} | ${why} |`,
    isExplained: why !== "" || means.every((mean) => mean <= maxEqualMean),
  };
}

const args = process.argv.slice(2);
const requestedNames = args.filter((argument) => argument !== "--check");
const all = readdirSync(join(here, "nodes"))
  .filter((file) => file.endsWith(".x3d"))
  .map((file) => file.replace(/\.x3d$/, ""))
  .sort();
const names = requestedNames.length > 0 ? all.filter((name) => requestedNames.includes(name)) : all;
mkdirSync(output, { recursive: true });
const browser = await launchChromium();
try {
  const rows = await showAll(browser, names);
  const sheet = await contactSheet(browser, rows);
  const lines = rows.map(lineOf);
  writeFileSync(join(output, "sheet.png"), sheet);
  console.log(lines.map(({ text }) => text).join("\n"));
  if (args.length === 0) {
    writeFileSync(picture, sheet);
    const head = readFileSync(table, "utf8").split(/^\| document/m)[0] ?? "";
    writeFileSync(
      table,
      `${head}| document | X_ITE | X3DOM | why imgeo differs |\n|---|--:|--:|---|\n${lines.map(({ text }) => text).join("\n")}\n`,
    );
  }
  const unexplained = rows.filter((_, i) => lines[i]?.isExplained === false).map(({ name }) => name);
  if (unexplained.length > 0) {
    console.error(`differ without an explanation: ${unexplained.join(", ")}`);
    process.exitCode = 1;
  }
} finally {
  await browser.close();
}
