// What of three.js a page's runtime leaves behind: shader text and objects that it
// would carry for materials and effects that X3D's looks never use. A bundler
// cannot know, since three.js finds its shaders by name and makes its objects
// whether or not they get work; so they are named here. The text of the other
// shaders loses comments and indents, as in three.js' own build.
//
// Our modules import from three.js' list of all that it has. When a bundler splits a
// page into parts, whoever imports from that list reaches all of it; so here each
// name is imported from the file that it is of.

import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "esbuild";

const three = join(import.meta.dirname, "../node_modules/three");
const shaders = "renderers/shaders";

/** Programs of materials that we have none of, and of shadows and environments. */
const unusedPrograms = [
  "backgroundCube",
  "cube",
  "depth",
  "distance",
  "equirect",
  "linedashed",
  "meshlambert",
  "meshmatcap",
  "meshnormal",
  "meshphysical",
  "meshtoon",
  "points",
  "shadow",
  "sprite",
  "vsm",
];

/** Included by these alone, or in whole of what is for shadows, probes and physical environments. */
const unusedChunks = [
  "alphahash_fragment",
  "alphahash_pars_fragment",
  "envmap_physical_pars_fragment",
  "gradientmap_pars_fragment",
  "iridescence_fragment",
  "iridescence_pars_fragment",
  "lightprobes_pars_fragment",
  "lights_lambert_fragment",
  "lights_lambert_pars_fragment",
  "lights_physical_fragment",
  "lights_physical_pars_fragment",
  "lights_toon_fragment",
  "lights_toon_pars_fragment",
  "packing",
  "shadowmap_pars_fragment",
  "shadowmap_pars_vertex",
  "shadowmap_vertex",
  "shadowmask_pars_fragment",
  "transmission_fragment",
  "transmission_pars_fragment",
];

/** What WebGLRenderer asks of what it never uses. */
const standIns: Readonly<Record<string, string>> = {
  "extras/PMREMGenerator.js": "export class PMREMGenerator {}",
  "renderers/shaders/DFGLUTData.js": "export function getDFGLUT() { return null; }",
  "renderers/webgl/WebGLShadowMap.js": `export class WebGLShadowMap {
    enabled = false; autoUpdate = true; needsUpdate = false; type = 0;
    render() {}
  }`,
  "renderers/webxr/WebXRManager.js": `export class WebXRManager {
    enabled = false; isPresenting = false; cameraAutoUpdate = true;
    addEventListener() {} removeEventListener() {} setAnimationLoop() {} getEnvironmentBlendMode() {} dispose() {}
  }`,
  ...Object.fromEntries(
    unusedPrograms.map((name) => [`${shaders}/ShaderLib/${name}.glsl.js`, 'export const vertex = "", fragment = "";']),
  ),
  ...Object.fromEntries(unusedChunks.map((name) => [`${shaders}/ShaderChunk/${name}.glsl.js`, 'export default "";'])),
};

/** By the names that three.js exports, the files that they are of. */
function filesByName(): ReadonlyMap<string, string> {
  const files = new Map<string, string>();
  for (const list of ["Three.Core.js", "Three.js"]) {
    const text = readFileSync(join(three, "src", list), "utf8");
    for (const [, names = "", file = ""] of text.matchAll(/^export \{(.*)\} from '(.*)';$/gm)) {
      for (const name of names.split(",")) files.set(name.trim(), join(three, "src", file));
    }
    for (const [, file = ""] of text.matchAll(/^export \* from '(.*constants\.js)';$/gm)) {
      const path = join(three, "src", file);
      for (const [, name = ""] of readFileSync(path, "utf8").matchAll(/^export const (\w+)/gm)) files.set(name, path);
    }
  }
  return files;
}

/** Of one of our modules. */
function withNamesFromTheirFiles(module: string, files: ReadonlyMap<string, string>): string {
  return module.replaceAll(
    /^import \{([^}]*)\} from "three";$/gm,
    (statement, names: string) =>
      names
        .split(",")
        .map((name) => name.trim())
        .filter((name) => name !== "")
        .map((name) => `import { ${name} } from ${JSON.stringify(files.get(name) ?? "three")};`)
        .join(" ") || statement,
  );
}

export const leanThree: Plugin = {
  name: "lean three.js",
  setup(build) {
    const missing = Object.keys(standIns).filter((path) => !existsSync(join(three, "src", path)));
    if (missing.length > 0) throw new Error(`three.js has no ${missing.join(", ")} any more`);
    // Its sources carry no notice of their own.
    const [notice] = /\/\*\*.*?\*\//s.exec(readFileSync(join(three, "build/three.module.js"), "utf8")) ?? [""];
    build.initialOptions.banner = { js: notice };
    build.onResolve({ filter: /^three$/ }, () => ({ path: join(three, "src/Three.js"), sideEffects: false }));
    const files = filesByName();
    build.onLoad({ filter: /web\/src\/.*\.ts$/ }, ({ path }) => ({
      contents: withNamesFromTheirFiles(readFileSync(path, "utf8"), files),
      loader: "ts",
    }));
    build.onLoad({ filter: /three\/src\/.*\.js$/ }, ({ path }) => {
      const standIn = standIns[path.slice(join(three, "src/").length)];
      if (standIn !== undefined) return { contents: standIn };
      return path.endsWith(".glsl.js") ? { contents: withoutComments(readFileSync(path, "utf8")) } : undefined;
    });
  },
};

/** Of GLSL in a module of three.js. */
function withoutComments(module: string): string {
  return module
    .replaceAll(/\/\*(?! glsl).*?\*\//gs, "")
    .replaceAll(/[ \t]*\/\/.*$/gm, "")
    .replaceAll(/^[ \t]+/gm, "")
    .replaceAll(/\n{2,}/g, "\n");
}
