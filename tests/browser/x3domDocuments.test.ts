// Draws documents of X3DOM's kind, all in one page, beside what `imgeo convert` makes of them: the pictures are equal,
// and of what cannot be read both say the same. `make soak` also converts, inspects, verifies and exports each of them.

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { assertSamePicture, savePicture } from "./compare.ts";
import { x3domFiles, x3domGeometries, x3domShape } from "./generators/x3domDocuments.ts";
import { withPage, type View } from "./harness.ts";
import { converter, outputDirectory } from "./paths.ts";
import type { Picture } from "./png.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

const site = (): string => siteOfGenerated("trefoil", "--profile", "classic");
const names = Object.keys(x3domGeometries);
const columns = 8;
/**
 * Edges move by a pixel where convert rounds coordinates to its own lattice, and a page shows the points of a mesh whose
 * index is cut. A shape is 0.3 % of the pixels.
 */
const bounds = { mean: 0.05, offShare: 0.001 };
/** Seconds: the page compiles a program for every kind of geometry, which a CPU does as the GPU. */
const patience = 90;

/** A page with all Shapes in a grid, each on a line of its own. */
function pageOfAll(): string {
  const shapes = Object.values(x3domGeometries).map((geometry, n) => {
    const at = `${2 * (n % columns) - columns + 1} ${2 * Math.floor(n / columns) - names.length / columns} 0`;
    return `<Transform translation="${at}">${x3domShape(geometry)}</Transform>`;
  });
  return pageOf(site())
    .replace(/<link rel="preload"[^>]*>/g, "")
    .replace(/<Shape[\s\S]*<\/Shape>/i, () => `\n${shapes.join("\n")}\n`)
    .replace(/<Viewpoint[^>]*>/i, '<Viewpoint position="0 0 26" orientation="0 0 1 0" fieldOfView="0.7">');
}

/** What the page says of each Shape that is left out, by the Shape's number. */
async function refusalsIn({ page }: View): Promise<Map<number, string>> {
  const errors = await page.evaluate(() => {
    const shapes = Array.from(document.querySelectorAll("shape"));
    const { errors } = document.querySelector("x3d") as unknown as {
      errors: { type: string; message: string; element: Element }[];
    };
    return errors.map(({ type, message, element }) => ({ type, message, shape: shapes.indexOf(element) }));
  });
  return new Map(errors.map(({ shape, type, message }) => [shape, `${type}: ${message}`]));
}

soakTest(
  "a page of X3DOM's nodes has the picture of what convert makes of it, and both leave out the same shapes",
  async () => {
    const html = pageOfAll();
    const folder = join(outputDirectory, "x3dom-documents");
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(folder, { recursive: true });
    writeFileSync(join(folder, "index.html"), html);
    for (const [name, body] of x3domFiles) writeFileSync(join(folder, name), body);
    const report = execFileSync(
      converter,
      ["convert", join(folder, "index.html"), "-o", join(folder, "site"), "--no-pictures", "--json"],
      { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] },
    );
    const { warnings } = JSON.parse(report) as { warnings: string[] };
    const firstLine = html.slice(0, html.indexOf("<Transform translation")).split("\n").length;
    const leftOut = new Map(
      warnings.flatMap((warning) => {
        const line = /index\.html:(\d+)/.exec(warning)?.[1];
        return line !== undefined &&
          /\bleft out/i.test(warning) &&
          !/the (images?|others) (is|are) left out/i.test(warning)
          ? [[Number(line) - firstLine, warning] as const]
          : [];
      }),
    );

    const expectedErrors = /none\.png|404|geometry>|holds 6 of 60/i;
    const serving = (server: View["server"]): void => {
      for (const [name, body] of x3domFiles) server.put(`/${name}`, body);
      server.when(/^\/$/, { replace: () => html });
    };
    let original: Picture | undefined;
    await withPage(site(), { server: serving, expectedErrors }, async (view) => {
      await view.promise("complete", "x3d", patience);
      original = await view.picture();
      const refusals = await refusalsIn(view);
      const namesOf = (numbers: Iterable<number>): string[] =>
        Array.from(numbers, (n) => names[n] ?? `shape ${n}`).sort();
      assert.deepEqual(namesOf(refusals.keys()), namesOf(leftOut.keys()));
    });
    const expected = original ?? assert.fail("no picture");
    savePicture("X3DOM's documents", expected);
    await withPage(join(folder, "site"), {}, async (view) => {
      await view.promise("complete", "x3d", patience);
      const picture = await view.picture();
      savePicture("X3DOM's documents, converted", picture);
      assertSamePicture("X3DOM's documents", picture, expected, bounds);
    });
  },
);

interface Outcome {
  readonly status: number | null;
  /** The report as JSON, empty where it failed. */
  readonly report: string;
  readonly problem: string;
}

soakTest("each document of X3DOM's nodes is converted, verified, inspected and exported, or refused", async () => {
  const folder = mkdtempSync(join(tmpdir(), "imgeo-"));
  const run = (...args: string[]): Outcome => {
    const { status, stdout, stderr } = spawnSync(converter, [...args, "--json"], { encoding: "utf8" });
    return { status, report: stdout, problem: stderr };
  };
  try {
    for (const [name, body] of x3domFiles) writeFileSync(join(folder, name), body);
    const document = join(folder, "document.x3d");
    const made = join(folder, "site");
    for (const [name, geometry] of Object.entries(x3domGeometries)) {
      const markup = x3domShape(geometry).replace(/<(img[^>]*[^/])>/g, "<$1/>");
      writeFileSync(document, `<X3D><Scene>${markup}</Scene></X3D>`);
      rmSync(made, { recursive: true, force: true });
      const converted = run("convert", document, "-o", made, "--no-pictures");
      assert.equal(converted.status, 0, `${name}: ${converted.problem}`);
      const { warnings } = JSON.parse(converted.report) as { warnings: string[] };
      const verified = run("verify", made, document);
      assert.equal(verified.status, 0, `${name}: ${verified.report} ${verified.problem}`);
      const strict = run("convert", "--strict", document, "-o", `${made}-strict`, "--no-pictures");
      const isSound = warnings.every((warning) => /^(Written as other nodes|Fields without effect)/.test(warning));
      assert.equal(strict.status, isSound ? 0 : 3, `${name}, --strict: ${strict.problem} ${warnings.join("; ")}`);
      for (const command of [
        ["info", document],
        ["export", document, "-o", join(folder, "out.glb")],
      ]) {
        const { status, problem } = run(...command);
        assert.ok(
          isSound ? status === 0 : [0, 2, 3].includes(status ?? -1),
          `${name}: ${command[0]}: ${status} ${problem}`,
        );
      }
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
  await Promise.resolve();
});
