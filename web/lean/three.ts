// three.js without what pages never use: objects for other materials and effects, which a bundler cannot find, since
// WebGLRenderer creates them unconditionally; shaders (shaders.ts); parameters of programs (parameters.ts); methods that
// nothing calls and branches that depend on properties which nothing sets (unusedMethods.ts, unsetProperties.ts).
//
// Our modules import from "three", which re-exports everything. When a bundler splits code, any module that imports from
// it reaches all of it; so each name is imported from the file that defines it.

import { existsSync, readFileSync, readdirSync, realpathSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import type { Plugin } from "rolldown";
import { withConstants } from "./constants.ts";
import { withLeanTemplates } from "./glsl.ts";
import { withoutUnusedParameters } from "./parameters.ts";
import { leanShaders } from "./shaders.ts";
import { withoutUnusedFunctions } from "./unusedFunctions.ts";

/** Without links, as bundlers name the files that they load. */
const three = realpathSync(join(import.meta.dirname, "../../node_modules/three/src"));

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
  // The textures that are used where a uniform has none, of kinds that no program of ours has.
  ...Object.fromEntries(
    ["CubeDepthTexture", "Data3DTexture", "DataArrayTexture", "DepthTexture"].map((name) => [
      `textures/${name}.js`,
      `export class ${name} {}`,
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
};

/** By the names that three.js exports, the files that define them. */
function filesByName(): ReadonlyMap<string, string> {
  const files = new Map<string, string>();
  for (const list of ["Three.Core.js", "Three.js"]) {
    const text = readFileSync(join(three, list), "utf8");
    for (const [, names = "", file = ""] of text.matchAll(/^export \{(.*)\} from '(.*)';$/gm)) {
      for (const name of names.split(",")) files.set(name.trim(), join(three, file));
    }
    for (const [, file = ""] of text.matchAll(/^export \* from '(.*)';$/gm))
      for (const [name, path] of namesIn(join(three, file))) files.set(name, path);
  }
  return files;
}

/** The names that a file defines and exports, or that are exported by way of it, with the files that define them. */
function namesIn(path: string): Map<string, string> {
  const text = readFileSync(path, "utf8");
  const definitions = text.matchAll(/^(?:export )?(?:const|class|function) (\w+)/gm);
  const imports = text.matchAll(/^import \{ (\w+) \} from '(.*)';$/gm);
  return new Map([
    ...Array.from(definitions, ([, name = ""]) => [name, path] as const),
    ...Array.from(imports, ([, name = "", file = ""]) => [name, join(dirname(path), file)] as const),
  ]);
}

/** Rewrites the imports of one of our modules. */
function withNamesFromTheirFiles(module: string, files: ReadonlyMap<string, string>): string {
  return module.replaceAll(
    /^import \{([^}]*)\} from "three";$/gm,
    (statement, names: string) =>
      names
        .split(",")
        .map((name) => name.trim())
        .filter((name) => name !== "" && !name.startsWith("type "))
        .map((name) => `import { ${name} } from ${JSON.stringify(files.get(name) ?? "three")};`)
        .join(" ") || statement,
  );
}

/** three.js' licence notice, which its source files do not carry. */
export const notice = /\/\*\*.*?\*\//s.exec(readFileSync(join(three, "../build/three.module.js"), "utf8"))?.[0] ?? "";

/** Whether a file is a source file of three.js. */
export function isOfThree(path: string): boolean {
  return path.startsWith(three);
}

/** The names of properties that its modules set, and of methods that they define. */
export function namesOfThree(): ReadonlySet<string> {
  const files = readdirSync(three, { recursive: true, encoding: "utf8" });
  const modules = files.filter((file) => file.endsWith(".js"));
  const texts = modules.map((file) => readFileSync(join(three, file), "utf8"));
  const definition = /\.(\w+) = |\b(\w+): |^\s+(?:[gs]et |static |async )?(\w+)\(.*\) \{$/gm;
  return new Set(texts.flatMap((text) => Array.from(text.matchAll(definition), ([, a, b, c]) => a ?? b ?? c ?? "")));
}

/** A module whose object `object` has no members but those that other modules name after it. */
export function withoutUnusedMembers(object: string, module: string, users: readonly string[]): string {
  const name = new RegExp(`\\b${object}\\.(\\w+)`, "g");
  const used = new Set(users.flatMap((text) => Array.from(text.matchAll(name), ([, member]) => member)));
  const start = module.indexOf(`const ${object} = {`);
  if (start < 0) throw new Error(`three.js has no ${object} any more`);
  const members = /^\t(\w+): \1,?$/gm;
  return (
    module.slice(0, start) +
    module.slice(start).replaceAll(members, (line, member: string) => (used.has(member) ? line : ""))
  );
}

/** `withoutUnused` removes what a program does not use from the text of a module of three.js. */
export function leanThree(withoutUnused: (module: string) => string): Plugin {
  const missing = Object.keys(standIns).filter((path) => !existsSync(join(three, path)));
  if (missing.length > 0) throw new Error(`three.js has no ${missing.join(", ")} any more`);
  const files = filesByName();
  const modules = ourModules();
  const shaders = leanShaders(three, modules);
  return {
    name: "lean three.js",
    resolveId: (name) => (name === "three" ? join(three, "Three.js") : undefined),
    load(path) {
      if (isOfThree(path)) {
        const name = relative(three, path);
        if (name === "math/MathUtils.js") return withoutUnusedMembers("MathUtils", readFileSync(path, "utf8"), modules);
        const module = shaders.get(name) ?? standIns[name] ?? withoutUnusedParameters(name, readFileSync(path, "utf8"));
        return name.endsWith(".glsl.js")
          ? module
          : withoutUnused(withoutUnusedFunctions(name, withConstants(name, module)));
      }
      if (!/web\/src\/.*\.ts$/.test(path)) return undefined;
      return { code: withNamesFromTheirFiles(withLeanTemplates(readFileSync(path, "utf8")), files), moduleType: "ts" };
    },
  };
}

/** The texts of our modules. */
function ourModules(): string[] {
  const folder = join(import.meta.dirname, "../src");
  const files = readdirSync(folder, { recursive: true, encoding: "utf8" }).filter((file) => file.endsWith(".ts"));
  return files.map((file) => readFileSync(join(folder, file), "utf8"));
}
