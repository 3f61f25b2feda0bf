// The pages of docs/decisions have a date, a status and the same five headings, and the index lists them all.
// Links between pages of docs lead to files and headings that exist.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { test } from "node:test";

const root = join(import.meta.dirname, "..");
const folder = join(root, "docs/decisions");
const pages = readdirSync(folder).filter((name) => name.endsWith(".md") && name !== "README.md");
const read = (path: string): string => readFileSync(path, "utf8");

/** The faults in the form of a page; empty if there are none. */
function faultsOf(text: string): string[] {
  const faults: string[] = [];
  if (!/^# \S.*\n\nDate: \d{4}-\d\d-\d\d\. Status: (accepted|superseded by \[.+\]\(.+\.md\))\.\n/.test(text))
    faults.push("title, date or status");
  const headings = [...text.matchAll(/^## (.*)$/gm)].map((match) => match[1]);
  if (headings.join() !== "Context,Options,Measurements,Decision,Consequences") faults.push("headings");
  return faults;
}

test("every decision has a date, a status and five headings", () => {
  assert.ok(pages.length > 10, "the pages were not found");
  assert.deepEqual(
    pages.flatMap((name) => faultsOf(read(join(folder, name))).map((fault) => `${name}: ${fault}`)),
    [],
  );
});

test("the check of the form finds a page without a status and one without consequences", () => {
  const headings = ["Context", "Options", "Measurements", "Decision", "Consequences"].map((name) => `## ${name}\n`);
  const head = "# A choice\n\nDate: 2026-11-22. Status: accepted.\n\n";
  assert.deepEqual(faultsOf(head + headings.join("\n")), []);
  assert.deepEqual(faultsOf("# A choice\n\n" + headings.join("\n")), ["title, date or status"]);
  assert.deepEqual(faultsOf(head + headings.slice(0, 4).join("\n")), ["headings"]);
});

test("the index lists every decision with its title and date", () => {
  const index = read(join(folder, "README.md"));
  for (const name of pages) {
    const text = read(join(folder, name));
    const title = /^# (.*)$/m.exec(text)?.[1] ?? "";
    const date = /^Date: (\S+)\./m.exec(text)?.[1] ?? "";
    assert.ok(index.includes(`| [${title}](${name}) | ${date} |`), `${name} is missing or has another title or date`);
  }
});

/** The anchors that GitHub and GitLab make of a page's headings. */
function anchorsOf(text: string): Set<string> {
  return new Set(
    [...text.matchAll(/^#+ (.*)$/gm)].map((match) =>
      (match[1] ?? "")
        .toLowerCase()
        .replace(/[^\p{L}\p{N}_ -]/gu, "")
        .replaceAll(" ", "-"),
    ),
  );
}

test("links of the documentation lead to files and headings that exist", () => {
  const documents = [
    ...readdirSync(root).filter((name) => name.endsWith(".md")),
    ...readdirSync(join(root, "docs"), { recursive: true, encoding: "utf8" })
      .filter((name) => name.endsWith(".md"))
      .map((name) => join("docs", name)),
    "web/README.md",
  ];
  const broken: string[] = [];
  for (const document of documents) {
    const path = join(root, document);
    for (const [, target = ""] of read(path).matchAll(/\]\(([^)\s]+)\)/g)) {
      if (/^[a-z]+:/.test(target)) continue;
      const [file = "", anchor] = target.split("#");
      const linked = file === "" ? path : join(dirname(path), file);
      if (!existsSync(linked)) broken.push(`${document}: ${target}`);
      else if (anchor !== undefined && linked.endsWith(".md") && !anchorsOf(read(linked)).has(anchor))
        broken.push(`${document}: ${target} (${relative(root, linked)} has no such heading)`);
    }
  }
  assert.deepEqual(broken, []);
});
