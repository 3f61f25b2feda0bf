// Converts scenes that move, and builds the page with all of them in build/motion, for any server: an X3D machine with
// ROUTEs, a glTF model with an animation, and two recorded simulations, one as files of frames, one as a lossless video.
//
//   node examples/motion/build.ts [OUTPUT]

import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { orrery } from "./orrery.ts";
import { motionPage } from "./page.ts";

const here = import.meta.dirname;
const repository = join(here, "../..");
const [output = join(repository, "build/motion")] = process.argv.slice(2);

const imgeo = (...words: string[]): void =>
  void execFileSync(join(repository, "build/imgeo"), words, { stdio: "ignore" });

function convert(source: string, folder: string, ...options: string[]): void {
  imgeo("convert", source, "-o", join(output, folder), ...options);
}

/** Records a simulation frame by frame, and converts it. */
function record(simulation: string, folder: string, ...options: string[]): void {
  const frames = join(output, "frames");
  imgeo("sample", simulation, "--frames", "240", "--grid", "96", "-o", frames);
  convert(join(frames, `${simulation}-*.ply`), folder, ...options);
  rmSync(frames, { recursive: true });
}

rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
for (const file of ["motion.css", "motion.js"]) cpSync(join(here, file), join(output, file));
convert(join(here, "engine.x3d"), "engine");
const model = join(output, "orrery.gltf");
writeFileSync(model, orrery());
convert(model, "orrery");
record("cloth", "cloth");
record("water", "water", "--as", "video");
writeFileSync(
  join(output, "index.html"),
  motionPage([
    {
      folder: "engine",
      title: "A steam engine in X3D",
      text: "A <code>TimeSensor</code> drives interpolators, whose values follow <code>ROUTE</code>s to the wheel, the rod, the piston and the valve. Touch the wheel to stop it and to start it again; drag the lamp.",
    },
    {
      folder: "orrery",
      title: "An orrery in glTF",
      text: "The animation of a glTF file, converted to the same nodes: arms that turn, one within the other.",
    },
    {
      folder: "cloth",
      title: "A recorded cloth",
      text: "Eight seconds of a simulation, frame by frame: files of a second each, which the page requests ahead and plays in a circle.",
    },
    {
      folder: "water",
      title: "Water in a lossless video",
      text: "Eight seconds of waves as one video, which <code>MovieTexture</code> names: its images hold the coordinates of the vertices, and the page displays each of them exactly. Browsers that cannot decode it play files of frames, which are there, too.",
    },
  ]),
);
