// Measures the time that a change of the document takes on the page's main thread in a scene of many shapes: 7,000
// boxes by USE and 3,000 of sizes and colours of their own, each in a Transform. Prints a Markdown table with the
// median and the minimum time of each change until everything but the picture has followed it.
//
//   scripts/bench changes          RUNTIME=folder: with the imgeo.js of another build

import { cpSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { startServer } from "../../tests/browser/server.ts";
import { changeTimes } from "../changeTimes.ts";
import { goUntilComplete } from "../completePage.ts";

const equalCount = 7000,
  otherCount = 3000;
const rounds = 15;
const timeout = 300_000;

function sceneText(): string {
  const shapes = Array.from({ length: equalCount + otherCount }, (_, n) => {
    const position = `${2 * (n % 100)} ${2 * Math.floor(n / 100)} 0`;
    const shape =
      n === 0
        ? '<Shape DEF="box"><Appearance><Material></Material></Appearance><Box size="1 1 1"></Box></Shape>'
        : n < equalCount
          ? '<Shape USE="box"></Shape>'
          : `<Shape><Appearance><Material diffuseColor="${(n % 7) / 7} ${(n % 11) / 11} 0.5"></Material></Appearance><Box size="1 1 ${1 + n / 10000}"></Box></Shape>`;
    return `<Transform translation="${position}">${shape}</Transform>`;
  });
  return `<X3D style="width:64px;height:48px;display:block" budget="1000"><Scene>${shapes.join("\n")}</Scene></X3D>`;
}

/** Self-contained functions that the page calls repeatedly; each call changes something. */
const changes: Record<string, (round: number) => void> = {
  "a Transform is moved": (round) => {
    document.querySelectorAll("transform")[5000]!.setAttribute("translation", `100 100 ${round % 2}`);
  },
  "a Shape is hidden, or shown": (round) => {
    document.querySelectorAll("shape")[8000]!.setAttribute("visible", String(round % 2 === 0));
  },
  "a Material is coloured": (round) => {
    document.querySelectorAll("material")[500]!.setAttribute("diffuseColor", `0.${round % 10} 0 0`);
  },
  "a Transform with a Shape is added": (round) => {
    const added = document.createElement("Transform");
    added.setAttribute("translation", `${round} 0 2`);
    added.innerHTML = '<Shape USE="box"></Shape>';
    document.querySelector("scene")!.append(added);
  },
  "a Transform is removed": () => {
    document.querySelectorAll("transform")[6000]!.remove();
  },
  "a Transform is inserted in the middle": (round) => {
    const added = document.createElement("Transform");
    added.innerHTML = "<Shape><Appearance><Material></Material></Appearance><Box></Box></Shape>";
    added.setAttribute("translation", `${round} 0 4`);
    document.querySelectorAll("transform")[3000]!.before(added);
  },
};

async function row(page: Page, name: string, change: (round: number) => void): Promise<string> {
  const times = await changeTimes(page, change, rounds, 150);
  const sorted = times.sort((a, b) => a - b);
  return `| ${name} | ${sorted[Math.floor(sorted.length / 2)]!.toFixed(2)} ms | ${sorted[0]!.toFixed(2)} ms |`;
}

const directory = mkdtempSync(join(tmpdir(), "imgeo-changes-"));
const runtime = process.env.RUNTIME ?? "web/dist";
for (const name of readdirSync(runtime)) cpSync(join(runtime, name), join(directory, name));
writeFileSync(
  join(directory, "index.html"),
  `<!DOCTYPE html><title>changes</title><script type="module" src="imgeo.js"></script>${sceneText()}`,
);
const server = await startServer(directory);
const browser = await launchChromium();
try {
  const page = await browser.newPage();
  await goUntilComplete(page, server.origin, timeout);
  console.log(`| in a scene of ${equalCount + otherCount} shapes | median | minimum |\n|---|--:|--:|`);
  for (const [name, change] of Object.entries(changes)) console.log(await row(page, name, change));
} finally {
  await browser.close();
  await server.close();
  rmSync(directory, { recursive: true });
}
