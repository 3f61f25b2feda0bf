// The shaders of three.js that pages use: without programs of other materials, without branches that are never compiled,
// and without chunks of which nothing is left then. Comments and indentation are removed, as in three.js' own build.

import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { withoutComments } from "./glsl.ts";
import { unusedNumbers, withoutUnusedLines, withoutUnusedParameters } from "./parameters.ts";
import { withoutUnusedBranches } from "./unusedBranches.ts";

/** Programs of other materials, of shadows and of environments, by the names of their files. */
const unusedPrograms = [
  "background",
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

/** Chunks that are replaced: of tone mapping, pages use no other function. */
const replacedChunks: Readonly<Record<string, string>> = {
  tonemapping_pars_fragment: `
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) { return clamp( toneMappingExposure * color, 0.0, 1.0 ); }
`,
};

/** The vertex and the fragment shader of a program, or the only text of a chunk. */
type Shaders = readonly string[];

const folder = "renderers/shaders";
const libraryPath = `${folder}/ShaderLib.js`;
const composerPath = "renderers/webgl/WebGLProgram.js";
const chunkPath = (name: string): string => `${folder}/ShaderChunk/${name}.glsl.js`;
const programPath = (name: string): string => `${folder}/ShaderLib/${name}.glsl.js`;

/**
 * The modules of three.js' shaders by their paths in `sources`, the folder of three.js' sources. `ours`: the texts of our
 * modules, whose chunks and defines are kept.
 */
export function leanShaders(sources: string, ours: readonly string[]): ReadonlyMap<string, string> {
  const composer = withoutUnusedParameters(composerPath, readFileSync(join(sources, composerPath), "utf8"));
  const named = new Set([
    ...Array.from(composer.matchAll(/ShaderChunk\[ '(\w+)' \]/g), ([, name = ""]) => name),
    ...ours.flatMap(includesIn),
  ]);
  const programs = readShaders(join(sources, folder, "ShaderLib"));
  const chunks = readShaders(join(sources, folder, "ShaderChunk"));
  for (const [name, text] of Object.entries(replacedChunks)) chunks.set(name, [text]);
  for (const name of unusedPrograms) if (!programs.delete(name)) throw new Error(`three.js has no ${name} any more`);
  const defined = namesDefinedIn([composer, ...[...programs.values(), ...chunks.values()].flat()], ours);
  const isUndefined = (name: string): boolean => !defined.has(name);
  prune(programs, chunks, named, isUndefined);
  return new Map([
    [composerPath, withoutUnusedLines(composer, isUndefined)],
    [`${folder}/ShaderChunk.js`, listOf(programs, chunks)],
    [libraryPath, withoutUnusedPrograms(readFileSync(join(sources, libraryPath), "utf8"), programs)],
    ...Array.from(
      programs,
      ([name, [vertex = "", fragment = ""]]) =>
        [programPath(name), `export const vertex = \`${vertex}\`, fragment = \`${fragment}\`;`] as const,
    ),
    ...Array.from(chunks, ([name, [text = ""]]) => [chunkPath(name), `export default \`${text}\`;`] as const),
  ]);
}

/** The shaders of a folder by the names of their files. */
function readShaders(of: string): Map<string, Shaders> {
  const files = readdirSync(of).filter((file) => file.endsWith(".glsl.js"));
  return new Map(
    files.map((file) => {
      const texts = readFileSync(join(of, file), "utf8").matchAll(/`([^`]*)`/g);
      return [file.replace(/\.glsl\.js$/, ""), Array.from(texts, ([, text = ""]) => withoutComments(text))];
    }),
  );
}

/** Removes branches that are never compiled, then what includes nothing but that, until nothing changes. */
function prune(
  programs: Map<string, Shaders>,
  chunks: Map<string, Shaders>,
  named: ReadonlySet<string>,
  isUndefined: (name: string) => boolean,
): void {
  for (let before = 0; ;) {
    const isLeft = (name: string): boolean =>
      named.has(name) || chunks.get(name)?.some((text) => text.trim() !== "") === true;
    const lean = (text: string): string =>
      withoutUnusedBranches(
        text.replaceAll(/^#include <(\w+)>\n?/gm, (line, name: string) => (isLeft(name) ? line : "")),
        isUndefined,
      );
    for (const all of [programs, chunks]) for (const [name, texts] of all) all.set(name, texts.map(lean));
    const used = new Set([...named, ...[...programs.values()].flat().flatMap(includesIn)]);
    for (const name of used)
      for (const text of chunks.get(name) ?? []) includesIn(text).forEach((one) => used.add(one));
    for (const name of chunks.keys()) if (!used.has(name)) chunks.delete(name);
    const size = [...programs.values(), ...chunks.values()].flat().join("").length;
    if (size === before) return;
    before = size;
  }
}

function includesIn(text: string): string[] {
  return Array.from(text.matchAll(/#include <(\w+)>/g), ([, name = ""]) => name);
}

/** Names that programs may define: those that shaders define, and all words of our modules that may be such a name. */
function namesDefinedIn(shaders: readonly string[], ours: readonly string[]): ReadonlySet<string> {
  const find = (texts: readonly string[], pattern: RegExp): string[] =>
    texts.flatMap((text) => Array.from(text.matchAll(pattern), ([, name = ""]) => name));
  const names = new Set([
    ...find(shaders, /#define\s+(\w+)/g),
    ...find(shaders, /\b(NUM_\w+|UNION_CLIPPING_PLANES)\b/g),
    ...find(ours, /\b([A-Z]\w+)\b/g),
  ]);
  for (const name of unusedNumbers) names.delete(name);
  return names;
}

/** The text of the module that lists all shaders by name. */
function listOf(programs: ReadonlyMap<string, Shaders>, chunks: ReadonlyMap<string, Shaders>): string {
  const imports = [
    ...Array.from(chunks.keys(), (name) => `import ${name} from "./ShaderChunk/${name}.glsl.js";`),
    ...Array.from(programs.keys(), (name) => `import * as ${name} from "./ShaderLib/${name}.glsl.js";`),
  ];
  const members = [
    ...chunks.keys(),
    ...Array.from(programs.keys(), (name) => `${name}_vert: ${name}.vertex, ${name}_frag: ${name}.fragment`),
  ];
  return `${imports.join("\n")}\nexport const ShaderChunk = { ${members.join(", ")} };`;
}

/** The text of the module that lists programs with their uniforms, without those of other materials. */
function withoutUnusedPrograms(library: string, programs: ReadonlyMap<string, Shaders>): string {
  const isUsed = (member: string): boolean => programs.has(/ShaderChunk\.(\w+)_vert/.exec(member)?.[1] ?? "");
  return library
    .replaceAll(/^\t\w+: \{\n.*?^\t\},?\n/gms, (member) => (isUsed(member) ? member : ""))
    .replaceAll(/^ShaderLib\.\w+ = \{\n.*?^\};\n/gms, (member) => (isUsed(member) ? member : ""));
}
