// Leaves out parts of three.js that pages never use: shaders and objects for other materials and
// effects. A bundler cannot find these, since three.js looks up shaders by name and creates its
// objects unconditionally; so they are listed here. Comments and indentation of the remaining
// shaders are removed, as in three.js' own build.
//
// Our modules import from "three", which re-exports everything. When a bundler splits code, any
// module that imports from it reaches all of it; so each name is imported from the file that
// defines it.

import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "esbuild";

const three = join(import.meta.dirname, "../node_modules/three");
const shaders = "renderers/shaders";

/** Shader programs of unused materials, of shadows and of environments. */
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

/** Chunks that only these programs include, and chunks for shadows, light probes and environments. */
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

/** Replacements for modules that WebGLRenderer imports and pages never use. */
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

/** By the names that three.js exports, the files that define them. */
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

/** Rewrites the imports of one of our modules. */
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
    // three.js' source files carry no licence notice of their own.
    const [notice] = /\/\*\*.*?\*\//s.exec(readFileSync(join(three, "build/three.module.js"), "utf8")) ?? [""];
    build.initialOptions.banner = { js: notice };
    build.onResolve({ filter: /^three$/ }, () => ({ path: join(three, "src/Three.js"), sideEffects: false }));
    const files = filesByName();
    build.onLoad({ filter: /web\/src\/.*\.ts$/ }, ({ path }) => ({
      contents: withNamesFromTheirFiles(withLeanShaders(readFileSync(path, "utf8")), files),
      loader: "ts",
    }));
    build.onLoad({ filter: /three\/src\/.*\.js$/ }, ({ path }) => {
      const standIn = standIns[path.slice(join(three, "src/").length)];
      if (standIn !== undefined) return { contents: standIn };
      return path.endsWith(".glsl.js") ? { contents: withoutComments(readFileSync(path, "utf8")) } : undefined;
    });
  },
};

/** Removes comments and indentation of GLSL in one of our modules, up to a template literal within it. */
function withLeanShaders(module: string): string {
  return module.replaceAll(/\/\* glsl \*\/ `[^`]*/g, (shader) =>
    shader.replaceAll(/[ \t]*\/\/.*$/gm, "").replaceAll(/\n\s+/g, "\n"),
  );
}

/** Removes comments and indentation of GLSL in a module of three.js. */
function withoutComments(module: string): string {
  return module
    .replaceAll(/\/\*(?! glsl).*?\*\//gs, "")
    .replaceAll(/[ \t]*\/\/.*$/gm, "")
    .replaceAll(/^[ \t]+/gm, "")
    .replaceAll(/\n{2,}/g, "\n");
}
