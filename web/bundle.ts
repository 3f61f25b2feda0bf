// Bundles the runtime into the ES modules of web/dist, which modules.txt lists: imgeo.js, which a page loads first, and
// which draws previews and loads the rest; imgeo-scene.js, what every scene needs, with three.js in it; imgeo-shared.js,
// which both import; further modules that come when a scene needs them; and imgeo-worker.js for workers.
// The `imgeo` executable contains them and copies them into every site.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import type { OutputChunk, OutputOptions, Plugin } from "rolldown";
import { rolldown } from "rolldown";
import { isOfThree, leanThree, namesOfThree, notice } from "./lean/three.ts";
import { platformNames } from "./lean/platformNames.ts";
import { unsetPropertiesOf, withoutProperties } from "./lean/unsetProperties.ts";
import { unusedMethodsOf, withoutMethods } from "./lean/unusedMethods.ts";

const sources = join(import.meta.dirname, "src");
const pageSource = join(sources, "dom/page.ts");
const runtimeSource = join(sources, "dom/register.ts");
/** The module of the bundler's own function that makes the object of a module's exports. */
const helperModule = "rolldown-runtime";
/** Previews load it, so that what it shares with the part "levels" must not be in the runtime. */
const firstGroupsSource = join(sources, "preview/firstGroups.ts");

interface BundleOptions {
  readonly plugins?: readonly Plugin[];
  /** Modules that are not part of the bundle. */
  readonly external?: readonly string[];
  readonly output?: OutputOptions;
}

/** Bundles a module with what it imports, minified. Returns the chunks. */
async function chunksOf(
  entry: string,
  { plugins = [], external = [], output = {} }: BundleOptions,
  minify: OutputOptions["minify"] = true,
): Promise<OutputChunk[]> {
  const bundle = await rolldown({
    input: entry,
    plugins: [...plugins],
    external: [...external],
    platform: "browser",
    preserveEntrySignatures: "allow-extension",
    transform: { target: "es2022" },
    logLevel: "warn",
  });
  const options: OutputOptions = { format: "esm", minify, postBanner: noticeOf, ...output };
  const { output: files } = await bundle.generate(options);
  await bundle.close();
  return files.filter((file) => file.type === "chunk");
}

function noticeOf({ moduleIds }: { readonly moduleIds: readonly string[] }): string {
  return moduleIds.some(isOfThree) ? notice : "";
}

/**
 * `chunksOf` with the parts of three.js that the entry needs. What is unused only because something else has been left
 * out is found in the second round; a third one finds a thousandth more.
 */
async function leanChunksOf(entry: string, options: BundleOptions = {}): Promise<OutputChunk[]> {
  const names = namesOfThree();
  let without = (module: string): string => module;
  for (let round = 0; round < 2; ++round) {
    const chunks = await chunksOf(entry, { ...options, plugins: [leanThree(without)] }, "dce-only");
    const texts = chunks.map(({ code }) => code);
    const properties = unsetPropertiesOf(texts, names, platformNames());
    const methods = unusedMethodsOf(texts);
    const before = without;
    without = (module) => withoutMethods(withoutProperties(before(module), properties), methods);
  }
  return chunksOf(entry, { ...options, plugins: [leanThree(without)] });
}

/** Bundles a module with what it imports into one, with the parts of three.js that it needs. Returns the module's text. */
export async function bundleWithThree(entry: string): Promise<string> {
  const [chunk] = await leanChunksOf(entry, { output: { codeSplitting: false } });
  return chunk?.code ?? "";
}

/** Bundles a module with what it imports into one, which imports the packages `external`. Returns the module's text. */
export async function bundleModule(entry: string, external: readonly string[] = []): Promise<string> {
  const [chunk] = await chunksOf(entry, { external, output: { codeSplitting: false } });
  return chunk?.code ?? "";
}

/** The whole runtime in one module. */
export function bundleRuntime(): Promise<string> {
  return bundleWithThree(join(sources, "dom/index.ts"));
}

export function bundleWorker(): Promise<string> {
  return bundleModule(join(sources, "workers/worker.ts"));
}

/** By the file that a module of web/dist is made of, the module's name. */
function modulesBySource(): ReadonlyMap<string, string> {
  const lines = readFileSync(join(import.meta.dirname, "modules.txt"), "utf8").split("\n");
  const words = lines.filter((line) => line !== "" && !line.startsWith("#")).map((line) => line.split(/\s+/));
  return new Map(words.map(([name = "", source = ""]) => [join(sources, source), name]));
}

/**
 * The modules of a site, without the worker: their texts by their names. Each contains what only it imports. Code that
 * several import is in the one that has been loaded before: `imgeo-shared`, or else `imgeo-scene`, or else `imgeo-cut`.
 * What several modules of parts import of which none imports another is in `imgeo-scene`, too.
 */
export async function bundleSite(): Promise<ReadonlyMap<string, string>> {
  const names = modulesBySource();
  const shared = names.get(join(sources, "shared")) ?? "";
  const others = [...names.keys()].filter((source) => source !== pageSource);
  const chunks = await leanChunksOf(pageSource, {
    output: {
      entryFileNames: "imgeo.js",
      chunkFileNames: ({ name, facadeModuleId }) => `${names.get(facadeModuleId ?? "") ?? name}.js`,
      codeSplitting: {
        includeDependenciesRecursively: false,
        groups: [
          {
            debugName: "modules.txt",
            name: (path, context) => {
              const importers = (of: string) => context.getModuleInfo(of)?.importers ?? [];
              if (isReached(path, pageSource, importers))
                return others.some((entry) => isReached(path, entry, importers)) ? shared : "imgeo";
              const holder = [runtimeSource, firstGroupsSource].find((entry) => isReached(path, entry, importers));
              if (holder !== undefined) return names.get(holder);
              const entries = others.filter((entry) => isReached(path, entry, importers));
              const importsOther = (entry: string) =>
                entries.some((other) => other !== entry && isReached(other, entry, importers));
              return entries.filter((entry) => !importsOther(entry)).length > 1 ? names.get(runtimeSource) : null;
            },
          },
        ],
      },
    },
  });
  const made = withHelperInside(new Map(chunks.map(({ fileName, code }) => [fileName.replace(/\.js$/, ""), code])));
  const unlisted = [...made.keys()].filter((name) => ![...names.values()].includes(name));
  const missing = [...names.values()].filter((name) => name !== "imgeo-worker" && !made.has(name));
  if (unlisted.length > 0 || missing.length > 0)
    throw new Error(`web/modules.txt lists other modules than these: ${[...made.keys()].join(", ")}`);
  return made;
}

/**
 * Puts the bundler's helper, which it makes a module of where several others need it, into each of these: it is small,
 * and a request is not.
 */
function withHelperInside(modules: ReadonlyMap<string, string>): Map<string, string> {
  const helper = modules.get(helperModule);
  const [exported, local] = /export *\{ *(\w+)(?: as \w+)? *\};?\s*$/.exec(helper ?? "") ?? [];
  if (helper === undefined || exported === undefined) return new Map(modules);
  const statements = helper.slice(0, -exported.length);
  const inlined = new RegExp(`import *\\{ *\\w+ as (\\w+) *\\} *from *"\\./${helperModule}\\.js";`);
  const others = [...modules].filter(([name]) => name !== helperModule);
  return new Map(
    others.map(([name, text]) => [name, text.replace(inlined, `const $1=(()=>{${statements}return ${local}})();`)]),
  );
}

/** Whether an entry's static imports lead to a module. */
function isReached(path: string, entry: string, importersOf: (path: string) => readonly string[]): boolean {
  const seen = new Set([path]);
  for (const module of seen) {
    if (module === entry) return true;
    for (const importer of importersOf(module)) seen.add(importer);
  }
  return false;
}

if (import.meta.main) {
  const outdir = join(import.meta.dirname, "dist");
  mkdirSync(outdir, { recursive: true });
  const modules = new Map(await bundleSite()).set("imgeo-worker", await bundleWorker());
  for (const [name, code] of modules) {
    writeFileSync(join(outdir, `${name}.js`), code);
    console.log(`web/dist/${name}.js ${code.length} bytes, ${gzipSync(code, { level: 9 }).byteLength} gzipped`);
  }
}
