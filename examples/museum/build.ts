// Builds the museum example with the Stanford dragon in build/museum, for any server.
//
//   node examples/museum/build.ts [SITE [OUTPUT]]

import { cpSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Note } from "./page.ts";
import { museumPage } from "./page.ts";

const here = import.meta.dirname;
const repository = join(here, "../..");
const [site = join(repository, "build/demo/dragon_vrip"), output = join(repository, "build/museum")] =
  process.argv.slice(2);

const notes: readonly Note[] = [
  {
    name: "Head",
    position: [-0.0452, 0.1625, 0.0032],
    normal: [0.358, 0.074, 0.931],
    text: "What no scan has seen, such as the inside of the mouth, was closed by carving away the space that is known to be empty.",
  },
  {
    name: "Scales",
    position: [0.0414, 0.1516, -0.0092],
    normal: [0.408, 0.735, 0.542],
    text: "437,645 points in 871,414 triangles. Press P to see the points alone.",
  },
  {
    name: "Tail",
    position: [0.0837, 0.1404, -0.0064],
    normal: [-0.107, -0.255, 0.961],
    text: "Many scans from all sides were merged into one surface (Curless and Levoy, 1996).",
  },
  {
    name: "Claw",
    position: [-0.052, 0.0676, 0.0355],
    normal: [0.465, 0.307, 0.83],
    text: "A small part of the bytes displayed the whole shape; details came first where you look.",
  },
];

rmSync(output, { recursive: true, force: true });
cpSync(site, output, { recursive: true });
cpSync(join(here, "museum.css"), join(output, "museum.css"));
const page = readFileSync(join(site, "index.html"), "utf8");
writeFileSync(
  join(output, "index.html"),
  museumPage(
    page,
    "The Stanford dragon",
    "Turn it with a finger, the mouse or the arrow keys. P shows its points.",
    notes,
  ),
);
