// Tests the npm package: packs it, installs it in a temporary folder without network access, and type-checks, bundles
// and builds (with Vite) apps that use it.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { after, before, describe, test } from "node:test";
import { build, type Metafile } from "esbuild";
import ts from "typescript";

const root = join(import.meta.dirname, "..");
const work = mkdtempSync(join(tmpdir(), "imgeo-package-"));
const app = join(work, "app");
let packed: string[] = [];

function run(directory: string, program: string, ...words: string[]): string {
  try {
    return execFileSync(program, words, { cwd: directory, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
  } catch (error) {
    const { stdout, stderr } = error as { stdout: string; stderr: string };
    throw new Error(`${words.join(" ")}: ${stdout}${stderr}`, { cause: error });
  }
}

before(() => {
  run(root, process.execPath, "web/package.ts", "--noCheck"); // `node --run check` checks the same types
  const [tarball] = JSON.parse(run(join(root, "web"), "npm", "pack", "--json", "--pack-destination", work)) as {
    filename: string;
    files: { path: string }[];
  }[];
  assert.ok(tarball);
  packed = tarball.files.map(({ path }) => path);
  mkdirSync(app);
  writeFileSync(join(app, "package.json"), JSON.stringify({ name: "app", private: true, type: "module" }));
  // The app brings peer dependencies; here they are those of this repository.
  run(
    app,
    "npm",
    "install",
    "--offline",
    "--legacy-peer-deps",
    "--no-audit",
    "--no-fund",
    join(work, tarball.filename),
  );
  mkdirSync(join(app, "node_modules/@types"));
  for (const name of ["three", "@types/three", "vite"])
    symlinkSync(join(root, "node_modules", name), join(app, "node_modules", name));
});

after(() => {
  rmSync(work, { recursive: true, force: true });
});

const users: Record<string, string> = {
  "loader.ts": `
    import { Color, Scene, MeshToonMaterial, type Object3D } from "three";
    import { ImgeoLoader, type ImgeoScene } from "imgeo/loader";
    const loader = new ImgeoLoader().setPath("statue/").setMaterial((material) =>
      new MeshToonMaterial({ color: new Color(...(material.kind === "phong" ? material.diffuseColor : [1, 1, 1])) }));
    const statue: ImgeoScene = await loader.loadAsync("scene.x3d", ({ loaded }) => { console.log(loaded); });
    const object: Object3D = statue;
    statue.addEventListener("change", () => { console.log(statue.box.min.x); });
    new Scene().add(object);
    // @ts-expect-error a URL is text
    loader.load(5, () => undefined);`,
  "element.ts": `
    import "imgeo";
    import type { ViewElement, ProgressDetail } from "imgeo";
    const x3d = document.querySelector<ViewElement>("x3d");
    await x3d?.complete;
    x3d?.addEventListener("progress", (event) => { console.log((event as CustomEvent<ProgressDetail>).detail.totalProgress); });`,
};

async function bundle(source: string): Promise<{ text: string; metafile: Metafile }> {
  const { outputFiles, metafile } = await build({
    stdin: { contents: source, resolveDir: app, loader: "ts" },
    external: ["three"],
    bundle: true,
    format: "esm",
    target: "es2022",
    write: false,
    metafile: true,
    logLevel: "error",
  });
  return { text: outputFiles[0]?.text ?? "", metafile };
}

/** The package's modules that contribute to a bundle. */
function modulesIn({ outputs }: Metafile): Set<string> {
  const inputs = Object.values(outputs).flatMap((output) => Object.entries(output.inputs));
  return new Set(
    inputs
      .filter(([, { bytesInOutput }]) => bytesInOutput > 0)
      .flatMap(([path]) => /imgeo\/lib\/(.*)\.js/.exec(path)?.[1] ?? []),
  );
}

function foldersIn(metafile: Metafile): Set<string> {
  return new Set(Array.from(modulesIn(metafile), (path) => path.split("/")[0] ?? ""));
}

/**
 * A fresh Vite project of an app: its files in a folder of its own beside the installed package. Returns the text of
 * each file that Vite builds.
 */
function viteBuild(name: string, source: string): Map<string, string> {
  const project = join(app, name);
  mkdirSync(project);
  writeFileSync(join(project, "main.ts"), source);
  writeFileSync(
    join(project, "index.html"),
    '<!DOCTYPE html><x3d></x3d><script type="module" src="/main.ts"></script>',
  );
  run(project, process.execPath, join(app, "node_modules/vite/bin/vite.js"), "build", "--logLevel", "error");
  const dist = join(project, "dist");
  const files = readdirSync(dist, { recursive: true, encoding: "utf8" }).filter((file) => /\.\w+$/.test(file));
  return new Map(files.map((file) => [file, readFileSync(join(dist, file), "utf8")]));
}

describe("the package", () => {
  test("holds modules, their types and the worker, and nothing else", () => {
    assert.ok(
      [
        "lib/loader/index.js",
        "lib/loader/index.d.ts",
        "lib/dom/index.js",
        "lib/workers/imgeo-worker.js",
        "lib/workers/imgeo-decoder.wasm",
        "README.md",
        "LICENSE",
        "NOTICE",
        "package.json",
      ].every((path) => packed.includes(path)),
    );
    assert.deepEqual(
      packed.filter((path) => /test|\.ts$/.test(path) && !path.endsWith(".d.ts")),
      [],
    );
  });

  test("types an app under strict rules", () => {
    for (const [name, text] of Object.entries(users)) writeFileSync(join(app, name), text);
    const options = {
      strict: true,
      module: ts.ModuleKind.NodeNext,
      target: ts.ScriptTarget.ES2022,
      lib: ["lib.es2024.d.ts", "lib.dom.d.ts", "lib.dom.iterable.d.ts"],
      noEmit: true,
      types: [],
    };
    const program = ts.createProgram(
      Object.keys(users).map((name) => join(app, name)),
      options,
    );
    // Those of the app and of the package. The declarations of the DOM and of three.js take `tsc` most of its time.
    const files = program.getSourceFiles().filter(({ fileName }) => fileName.startsWith(app));
    assert.ok(files.some(({ fileName }) => fileName.endsWith("node_modules/imgeo/lib/loader/ImgeoLoader.d.ts")));
    const diagnostics = [
      ...program.getOptionsDiagnostics(),
      ...program.getGlobalDiagnostics(),
      ...files.flatMap((file) => [...program.getSyntacticDiagnostics(file), ...program.getSemanticDiagnostics(file)]),
    ];
    const messages = diagnostics.map(({ file, messageText }) => [
      file?.fileName,
      ts.flattenDiagnosticMessageText(messageText, "\n"),
    ]);
    assert.deepEqual(messages, []);
  });

  test("leaves in an app only what it uses", async () => {
    const loader = await bundle(users["loader.ts"] ?? "");
    const folders = foldersIn(loader.metafile);
    assert.ok(folders.has("loader") && folders.has("render"));
    assert.ok(!folders.has("dom"), "the element is in the loader's bundle");
    assert.ok(!folders.has("navigation"), "camera control is in the loader's bundle");
    assert.doesNotMatch(loader.text, /customElements|x3dMaterials|keydown/);
    const nothing = await bundle(`import { ImgeoLoader } from "imgeo/loader"; import "three"; console.log(1);`);
    assert.deepEqual([...foldersIn(nothing.metafile)], []);
    const element = await bundle(users["element.ts"] ?? "");
    assert.ok(foldersIn(element.metafile).has("dom"));
    assert.match(element.text, /customElements\.define/);
  });

  for (const [name, text] of Object.entries(users)) {
    test(`builds in a fresh Vite project that uses ${name}`, () => {
      const files = viteBuild(name.replace(".ts", ""), text);
      const page = files.get("index.html") ?? "";
      const [, entry = ""] = /src="\/(assets\/[^"]+\.js)"/.exec(page) ?? [];
      const bundle = files.get(entry) ?? "";
      const worker = Array.from(files.keys()).find((file) => /^assets\/imgeo-worker-[^/]*\.js$/.test(file));
      assert.ok(worker !== undefined, `Vite copies the worker; it has built ${Array.from(files.keys()).join(", ")}`);
      assert.ok(bundle.includes(basename(worker)), "the bundle names the worker that Vite has copied");
      assert.equal(
        files.get(worker),
        readFileSync(join(app, "node_modules/imgeo/lib/workers/imgeo-worker.js"), "utf8"),
      );
      const decoder = Array.from(files.keys()).find((file) => /^assets\/imgeo-decoder-[^/]*\.wasm$/.test(file));
      assert.ok(decoder !== undefined && bundle.includes(basename(decoder)), "the bundle names the decoder, too");
      // Vite divides what the entry shares with parts.
      const scripts = Array.from(files).flatMap(([file, code]) =>
        file.endsWith(".js") && file !== worker ? [code] : [],
      );
      assert.match(
        scripts.join("\n"),
        /WebGLRenderer|isObject3D/,
        "the bundle holds the parts of three.js that it uses",
      );
      assert.equal(bundle.includes("customElements.define"), name === "element.ts");
    });
  }

  test("names its licence and may be published", () => {
    const manifest = JSON.parse(readFileSync(join(app, "node_modules/imgeo/package.json"), "utf8")) as {
      private?: boolean;
      license: string;
      types: string;
      exports: Record<string, string | Record<string, string>>;
    };
    assert.deepEqual([manifest.license, manifest.private], ["Apache-2.0", undefined]);
    const targets = Object.values(manifest.exports).flatMap((target) =>
      typeof target === "string" ? [target] : Object.values(target),
    );
    const missing = [manifest.types, ...targets].filter((path) => !packed.includes(path.replace("./", "")));
    assert.deepEqual(missing, [], "types and exports name files of the package");
  });

  test("carries three.js as a peer of one range with the tested release", () => {
    const { peerDependencies } = JSON.parse(readFileSync(join(root, "web/package.json"), "utf8")) as {
      peerDependencies: Record<string, string>;
    };
    const { devDependencies } = JSON.parse(readFileSync(join(root, "package.json"), "utf8")) as {
      devDependencies: Record<string, string>;
    };
    assert.equal(peerDependencies.three, `>=${devDependencies.three} <1`);
  });
});
