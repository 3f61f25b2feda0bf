// The scenes of the benchmark: a generated hall and public scenes of Debian packages, each with two cameras that see
// different shapes first.

import { execFileSync } from "node:child_process";
import { cpSync, existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { converter } from "../../tests/browser/paths.ts";

export interface Camera {
  readonly name: string;
  /** Attributes of <x3d>; empty for the scene's own camera. */
  readonly attributes: string;
}

export interface Input {
  readonly name: string;
  /** File name and package, or command, for people. */
  readonly source: string;
  /** Path of the file; empty for the generated hall. */
  readonly file: string;
  readonly cameras: readonly [Camera, Camera];
}

/** Folder into which Debian packages are unpacked: "/", or a folder of `dpkg-deb --extract`. */
const root = process.env.IMGEO_PACKAGES ?? "/";
const models = join(root, "usr/share/assimp/models");
const castle = join(root, "usr/share/doc/castle-game-engine-doc/examples");

const cameraAt = (name: string, target: string, orbit: string): Camera => ({
  name,
  attributes: `camera-target="${target}" camera-orbit="${orbit}"`,
});

export const inputs: readonly Input[] = [
  {
    name: "hall",
    source: "`imgeo sample hall --seats 2000`",
    file: "",
    cameras: [{ name: "from the door", attributes: "" }, cameraAt("from the stage", "0m 2.4m 10m", "180deg 88deg 11m")],
  },
  {
    name: "house",
    source: "`AC14-FZK-Haus.ifc` of assimp-testmodels",
    file: join(models, "IFC/AC14-FZK-Haus.ifc"),
    cameras: [{ name: "from the garden", attributes: "" }, cameraAt("in the kitchen", "4m 1.6m -3m", "90deg 85deg 3m")],
  },
  {
    name: "engine",
    source: "`2CylinderEngine.glb` of assimp-testmodels",
    file: join(models, "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"),
    cameras: [
      { name: "of the whole engine", attributes: "" },
      { name: "at one end", attributes: 'camera-orbit="80deg 85deg 40%"' },
    ],
  },
  {
    name: "dungeon",
    source: "`level-dungeon.gltf` of castle-game-engine-doc",
    file: join(castle, "third_person_navigation/data/level/level-dungeon.gltf"),
    cameras: [
      cameraAt("in its yard", "10m 1m 0m", "150deg 75deg 14m"),
      cameraAt("at its gate", "-28m 1m 0m", "90deg 80deg 8m"),
    ],
  },
  {
    name: "bridge",
    source: "`bridge.x3d` of castle-game-engine-doc",
    file: join(castle, "viewport_and_scenes/view_3d_model_basic/data/bridge.x3d"),
    cameras: [{ name: "from the water", attributes: "" }, cameraAt("on it", "15m 2m 0m", "80deg 80deg 20m")],
  },
];

/** The input's file; undefined, with a message, if its package is not installed. */
export function fileOf(input: Input, work: string): string | undefined {
  if (input.file === "") {
    const file = join(work, `${input.name}.glb`);
    execFileSync(converter, ["sample", "hall", "--seats", "2000", "-o", file], {
      stdio: ["ignore", "ignore", "inherit"],
    });
    return file;
  }
  if (existsSync(input.file)) return input.file;
  console.error(`imgeo: ${input.file} is missing; ${input.name} is skipped`);
  return undefined;
}

/** Two copies of the site that `imgeo convert` makes of a file, which open with the first and the second camera. */
export function sitesOf(input: Input, file: string, work: string): [string, string] {
  const [first, second] = [join(work, `${input.name}-1`), join(work, `${input.name}-2`)];
  execFileSync(converter, ["convert", file, "-o", first], { stdio: ["ignore", "ignore", "ignore"] });
  cpSync(first, second, { recursive: true });
  for (const [camera, site] of [first, second].entries()) {
    const page = join(site, "index.html");
    writeFileSync(
      page,
      readFileSync(page, "utf8").replace("<X3D ", `<X3D ${input.cameras[camera]?.attributes ?? ""} `),
    );
  }
  return [first, second];
}
