// Leaves out parts of three.js that pages never use: shaders and objects for other materials and
// effects. A bundler cannot find these, since three.js looks up shaders by name and creates its
// objects unconditionally; so they are listed here. Comments and indentation of the remaining
// shaders are removed, as in three.js' own build.
//
// Our modules import from "three", which re-exports everything. When a bundler splits code, any
// module that imports from it reaches all of it; so each name is imported from the file that
// defines it.
//
// Methods that no code of a bundle calls are removed, too (unusedMethods.ts).

import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "rolldown";

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

/**
 * Chunks for shadows, environments, skins and morph targets of three.js, which other chunks include. Chunks that nothing
 * includes are left out without a list.
 */
const unusedChunks = [
  "batching_pars_vertex",
  "batching_vertex",
  "displacementmap_pars_vertex",
  "displacementmap_vertex",
  "envmap_common_pars_fragment",
  "envmap_fragment",
  "envmap_pars_fragment",
  "envmap_pars_vertex",
  "envmap_vertex",
  "lightmap_pars_fragment",
  "morphcolor_vertex",
  "morphinstance_vertex",
  "morphnormal_vertex",
  "morphtarget_pars_vertex",
  "morphtarget_vertex",
  "shadowmap_pars_fragment",
  "shadowmap_pars_vertex",
  "shadowmap_vertex",
  "shadowmask_pars_fragment",
  "skinbase_vertex",
  "skinning_pars_vertex",
  "skinning_vertex",
  "skinnormal_vertex",
];

const shadow = (name: string): string => `export class ${name} { map = null; dispose() {} clone() { return this; } }`;

/** Replacements for modules that WebGLRenderer imports and pages never use. */
const standIns: Readonly<Record<string, string>> = {
  "extras/PMREMGenerator.js": "export class PMREMGenerator {}",
  "geometries/BoxGeometry.js": "export class BoxGeometry {}", // of backgrounds that are textures
  "geometries/PlaneGeometry.js": "export class PlaneGeometry {}",
  ...Object.fromEntries(
    ["DirectionalLightShadow", "PointLightShadow", "SpotLightShadow"].map((name) => [
      `lights/${name}.js`,
      shadow(name),
    ]),
  ),
  "math/FrustumArray.js": "export class FrustumArray {}", // of ArrayCamera
  "renderers/webgl/WebGLEnvironments.js": "export class WebGLEnvironments { get() { return null; } dispose() {} }",
  "renderers/webgl/WebGLMorphtargets.js": "export class WebGLMorphtargets { update() {} }",
  "renderers/webgl/WebGLOutput.js": "export class WebGLOutput {}", // of output buffers of other types
  "renderers/webgl/WebGLUniformsGroups.js": "export class WebGLUniformsGroups { update() {} bind() {} dispose() {} }",
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
  [`${shaders}/ShaderChunk/tonemapping_pars_fragment.glsl.js`]: `export default \`
    uniform float toneMappingExposure;
    vec3 LinearToneMapping( vec3 color ) { return clamp( toneMappingExposure * color, 0.0, 1.0 ); }
  \`;`,
  ...Object.fromEntries(
    [...unusedChunks, ...chunksWithoutUse()].map((name) => [
      `${shaders}/ShaderChunk/${name}.glsl.js`,
      'export default "";',
    ]),
  ),
};

/** The names of chunks that neither a program which is left includes, nor WebGLProgram.js names. */
function chunksWithoutUse(): readonly string[] {
  const nameOf = (file: string): string => file.replace(/\.glsl\.js$/, "");
  const namesIn = (folder: string): string[] =>
    readdirSync(join(three, "src", shaders, folder))
      .filter((file) => file.endsWith(".glsl.js"))
      .map(nameOf);
  const includesOf = (folder: string, name: string): string[] => {
    const text = readFileSync(join(three, "src", shaders, folder, `${name}.glsl.js`), "utf8");
    return Array.from(text.matchAll(/#include <(\w+)>/g), ([, included = ""]) => included);
  };
  const programs = namesIn("ShaderLib").filter((name) => !unusedPrograms.includes(name));
  const used = new Set(programs.flatMap((program) => includesOf("ShaderLib", program)));
  const composer = readFileSync(join(three, "src/renderers/webgl/WebGLProgram.js"), "utf8");
  for (const [, name = ""] of composer.matchAll(/ShaderChunk\[ '(\w+)' \]/g)) used.add(name);
  for (const name of used) for (const included of includesOf("ShaderChunk", name)) used.add(included);
  return namesIn("ShaderChunk").filter((name) => !used.has(name));
}

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

/** three.js' licence notice, which its source files do not carry. */
export const notice = /\/\*\*.*?\*\//s.exec(readFileSync(join(three, "build/three.module.js"), "utf8"))?.[0] ?? "";

/** Whether a file is a source file of three.js. */
export function isOfThree(path: string): boolean {
  return path.startsWith(join(three, "src/"));
}

/** `withoutUnused` removes methods that nothing calls from the text of a module of three.js. */
export function leanThree(withoutUnused: (module: string) => string): Plugin {
  const missing = Object.keys(standIns).filter((path) => !existsSync(join(three, "src", path)));
  if (missing.length > 0) throw new Error(`three.js has no ${missing.join(", ")} any more`);
  const files = filesByName();
  return {
    name: "lean three.js",
    resolveId: (name) => (name === "three" ? join(three, "src/Three.js") : undefined),
    load(path) {
      if (!isOfThree(path)) {
        if (!/web\/src\/.*\.ts$/.test(path)) return undefined;
        const module = readFileSync(path, "utf8");
        requireChunks(path, module);
        return { code: withNamesFromTheirFiles(withLeanShaders(module), files), moduleType: "ts" };
      }
      const module = standIns[path.slice(join(three, "src/").length)] ?? readFileSync(path, "utf8");
      return path.endsWith(".glsl.js") ? withoutComments(module) : withoutUnused(module);
    },
  };
}

/** Throws an Error if one of our modules includes a chunk that is left out. */
function requireChunks(path: string, module: string): void {
  for (const [, name = ""] of module.matchAll(/#include <(\w+)>/g))
    if (standIns[`${shaders}/ShaderChunk/${name}.glsl.js`] === 'export default "";')
      throw new Error(`${path} includes ${name}, which is left out of three.js`);
}

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
