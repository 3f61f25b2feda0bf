// Which modules of the runtime pages load, and how many bytes they have.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";
import { brotliCompressSync } from "node:zlib";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { drag, focusView } from "./gestures.ts";
import { pictureSize, settle, until, withPage, type View } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import { writeRiggedScene } from "./riggedScene.ts";
import { gate } from "./server.ts";
import { siteOf, siteOfGenerated, siteOfRelief } from "./sites.ts";
import { soakTest } from "./soak.ts";

const moduleName = /^(imgeo(?:-[a-z]+)?)-[0-9a-f]{16}\.js$/;

/** The modules that a page has requested, without those of workers. */
function modulesOf({ requestedPaths }: View): string[] {
  const files = requestedPaths.map((path) => basename(path)).filter((file) => moduleName.test(file));
  return [...new Set(files)].filter((file) => !file.startsWith("imgeo-worker")).sort();
}

function namesOf(files: readonly string[]): string[] {
  return files.map((file) => moduleName.exec(file)?.[1] ?? "").sort();
}

/** The site of an X3D document with these nodes. */
function siteOfX3d(name: string, nodes: string): string {
  const source = join(outputDirectory, "modules-sources");
  mkdirSync(source, { recursive: true });
  const file = join(source, `${name}.x3d`);
  writeFileSync(file, `<X3D><Scene>${nodes}</Scene></X3D>`);
  return siteOf(file);
}

/** The bound of a statue's page, with three.js. Raise it only for what every scene needs: others have modules (web/modules.txt). */
const maxBrotliBytes = 152_000;

test("a page with a statue loads three modules, also when it is turned", async () => {
  const site = siteOfGenerated("trefoil-large");
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    await drag(view, 60, 20);
    await settle(view.page);
    const files = modulesOf(view);
    assert.deepEqual(namesOf(files), ["imgeo", "imgeo-scene", "imgeo-shared"]);
    const sizes = files.map((file) => brotliCompressSync(readFileSync(join(site, "runtime", file))).length);
    const bytes = sizes.reduce((sum, each) => sum + each, 0);
    assert.ok(bytes <= maxBrotliBytes, `${files.join(", ")}: ${bytes} bytes`);
  });
});

soakTest("the module of help is requested again after it has failed, with one warning", async () => {
  await withPage(siteOfGenerated("trefoil-large"), { expectedErrors: /Failed to load resource/ }, async (view) => {
    await view.promise("complete");
    await drag(view, 60, 20); // gives it the focus
    const warnings: string[] = [];
    view.page.on("console", (message) => {
      if (message.type() === "warning" && message.text().startsWith("imgeo:")) warnings.push(message.text());
    });
    const allow = view.server.when(/imgeo-overlays-/, { status: 503 });
    for (const count of [1, 2]) {
      await view.page.keyboard.press("?");
      await until("it has failed", () => view.server.requestsOf(/imgeo-overlays-/).length === count);
      await settle(view.page);
    }
    await until("there is a warning", () => warnings.length > 0);
    allow();
    const help = view.page.getByRole("dialog", { name: "How to turn the scene" });
    assert.equal(await help.count(), 0);
    await view.page.keyboard.press("?");
    await help.waitFor();
    assert.equal(warnings.length, 1, warnings.join("\n"));
    assert.match(warnings[0]!, /the module for hotspots, links, menus and help could not be loaded: .*imgeo-overlays-/);
  });
});

test("a page of a mesh with levels also loads their two modules, one of them before any module arrives", async () => {
  const site = siteOfRelief(8000, "--levels", "always", "--group-triangles", "1024");
  const [first, runtime] = [gate(), gate()];
  const server = (server: View["server"]): void => {
    server.when(/imgeo-shared-/, { hold: first.closed });
    server.when(/imgeo-scene-/, { hold: runtime.closed });
  };
  await withPage(site, { server }, async (view) => {
    await until("the first module is requested", () => view.server.requestsOf(/imgeo-cut-/).length > 0);
    first.open();
    await until("the second module is requested", () => view.server.requestsOf(/imgeo-levels-/).length > 0);
    runtime.open();
    await view.promise("complete");
    assert.deepEqual(namesOf(modulesOf(view)), ["imgeo", "imgeo-cut", "imgeo-levels", "imgeo-scene", "imgeo-shared"]);
  });
});

soakTest("pages of SIG classic and BG request the module for their files before any module has arrived", async () => {
  for (const options of [
    ["--profile", "classic"],
    ["--container", "bg"],
  ]) {
    const { closed, open } = gate();
    const server = (server: View["server"]): void => {
      server.when(/imgeo-shared-/, { hold: closed });
    };
    await withPage(siteOfRelief(2000, ...options), { server }, async (view) => {
      await until("the module is requested", () => view.server.requestsOf(/imgeo-files-/).length > 0);
      open();
      await view.promise("complete");
      assert.equal(view.server.requestsOf(/imgeo-files-/).length, 1);
      assert.deepEqual(namesOf(modulesOf(view)), ["imgeo", "imgeo-files", "imgeo-scene", "imgeo-shared"]);
    });
  }
});

test("a page of many shapes, one with operators, requests their modules before the runtime has arrived", async () => {
  const boxes = "<Shape><Box/></Shape>".repeat(15) + "<Shape><Box operators='scale(0.5)'/></Shape>";
  const { closed, open } = gate();
  const server = (server: View["server"]): void => {
    server.when(/imgeo-scene-/, { hold: closed });
  };
  await withPage(siteOfX3d("boxes", boxes), { server }, async (view) => {
    for (const name of ["batches", "operators"])
      await until("the module is requested", () => view.server.requestsOf(new RegExp(`imgeo-${name}-`)).length > 0);
    open();
    await view.promise("complete");
    const loaded = ["batches", "files", "geometry", "operators", "scene", "shared"];
    assert.deepEqual(namesOf(modulesOf(view)), ["imgeo", ...loaded.map((name) => `imgeo-${name}`)]);
  });
});

test("a page with a fog and a local light requests their module early; a click waits for that of links", async () => {
  const { closed, open } = gate();
  const later = gate();
  const server = (server: View["server"]): void => {
    server.when(/imgeo-scene-/, { hold: closed });
    server.when(/imgeo-overlays-/, { hold: later.closed });
  };
  const shape = "<Anchor url='#there'><Shape><Box/></Shape></Anchor>";
  const nodes = `<Fog visibilityRange='20'/><Group><DirectionalLight/>${shape}</Group>`;
  await withPage(siteOfX3d("fog", nodes), { server }, async (view) => {
    for (const name of ["environment", "overlays"])
      await until("the module is requested", () => view.server.requestsOf(new RegExp(`imgeo-${name}-`)).length > 0);
    open();
    await view.promise("firstImage");
    const { page } = view;
    await page.mouse.click(pictureSize.width / 2, pictureSize.height / 2);
    await page.keyboard.press("?");
    await settle(page);
    const [hash, help] = [() => page.evaluate(() => location.hash), page.getByRole("dialog")];
    assert.deepEqual([await hash(), await help.count(), await view.events("load", "x3d")], ["", 0, []]);
    later.open();
    await until("the link is followed", async () => (await hash()) === "#there");
    await help.waitFor();
    await view.promise("complete");
    const loaded = ["environment", "files", "geometry", "overlays", "scene", "shared"];
    assert.deepEqual(namesOf(modulesOf(view)), ["imgeo", ...loaded.map((name) => `imgeo-${name}`)]);
  });
});

test("a page that begins with WALK requests its module before the runtime has arrived, others when the user chooses it", async () => {
  const box = "<Shape><Box/></Shape>";
  const { closed, open } = gate();
  const server = (server: View["server"]): void => {
    server.when(/imgeo-scene-/, { hold: closed });
  };
  await withPage(siteOfX3d("walk", `<NavigationInfo type='"WALK"'/>${box}`), { server }, async (view) => {
    await until("the module is requested", () => view.server.requestsOf(/imgeo-walking-/).length > 0);
    open();
    await view.promise("complete");
  });
  const site = siteOfX3d("walk-later", `<NavigationInfo type='"EXAMINE" "WALK"' transitionTime='0'/>${box}`);
  await withPage(site, {}, async (view) => {
    const distance = (): Promise<number> =>
      view.page.evaluate(() => {
        const { x, y, z } = document.querySelector<ViewElement>("x3d")!.getCameraPosition();
        return Math.hypot(x, y, z);
      });
    await view.promise("complete");
    assert.ok(!namesOf(modulesOf(view)).includes("imgeo-walking"));
    const later = gate();
    view.server.when(/imgeo-walking-/, { hold: later.closed });
    await focusView(view);
    const before = await distance();
    await view.page.keyboard.press("w");
    await view.page.keyboard.down("ArrowUp");
    await until("the module is requested", () => view.server.requestsOf(/imgeo-walking-/).length > 0);
    await view.page.evaluate(
      () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
    );
    assert.equal(await distance(), before);
    later.open();
    await until("the held key moves the camera", async () => (await distance()) < before);
    await view.page.keyboard.up("ArrowUp");
  });
});

test("a page with skins and morph targets requests their module before the runtime has arrived", async () => {
  const { closed, open } = gate();
  const server = (server: View["server"]): void => {
    server.when(/imgeo-scene-/, { hold: closed });
  };
  await withPage(siteOf(writeRiggedScene()), { server }, async (view) => {
    await until("the module is requested", () => view.server.requestsOf(/imgeo-deformation-/).length > 0);
    open();
    await view.promise("complete");
  });
});

const animatedNodes =
  "<TimeSensor DEF='clock' loop='true'/><PositionInterpolator DEF='path' key='0 1' keyValue='0 0 0 1 0 0'/>" +
  "<Transform DEF='moved'><Shape><Box/></Shape></Transform>" +
  "<ROUTE fromNode='clock' fromField='fraction_changed' toNode='path' toField='set_fraction'/>" +
  "<ROUTE fromNode='path' fromField='value_changed' toNode='moved' toField='set_translation'/>";

test("a page with a ROUTE requests the module that animates it before the runtime has arrived", async () => {
  const { closed, open } = gate();
  const server = (server: View["server"]): void => {
    server.when(/imgeo-scene-/, { hold: closed });
  };
  await withPage(siteOfX3d("animated", animatedNodes), { server }, async (view) => {
    await until("the module is requested", () => view.server.requestsOf(/imgeo-animation-/).length > 0);
    open();
    await view.promise("complete");
    assert.equal(view.server.requestsOf(/imgeo-animation-/).length, 1);
  });
});

for (const { part, nodes } of [
  { part: "environment", nodes: "<Fog visibilityRange='20'/><Shape><Box/></Shape>" },
  { part: "files", nodes: "<Shape><Box/></Shape>" },
])
  (part === "files" ? test : soakTest)(
    `a page that lacks the module imgeo-${part} has one error and is complete; the next change tries again`,
    async () => {
      let allow = (): void => undefined;
      const server = (server: View["server"]): void => {
        allow = server.when(new RegExp(`imgeo-${part}-`), { status: 503 });
      };
      const site = siteOfX3d(`failing-${part}`, nodes);
      await withPage(site, { server, expectedErrors: /503|could not be loaded/ }, async (view) => {
        await view.promise("complete");
        await settle(view.page);
        const errors = await view.events("error", "x3d");
        assert.deepEqual(
          errors.map(({ detail }) => [detail.type, detail.url]),
          [["network", ""]],
        );
        assert.equal((await view.events("load", "x3d")).length, 1);
        assert.deepEqual(await view.events("first-image", "x3d"), []);
        const bar = view.page.getByRole("progressbar", { name: "Loading" });
        assert.equal(await bar.count(), 0);

        allow();
        await view.page.evaluate(() => {
          document.querySelector("box")?.setAttribute("size", "1 2 3");
        });
        await until("the shape is displayed", async () => (await view.events("first-image", "x3d")).length > 0);
        await view.promise("complete");
        assert.equal((await view.events("error", "x3d")).length, 1);
      });
    },
  );

test("a page whose module imgeo-animation cannot be loaded displays the scene at rest, with one warning", async () => {
  const warnings: string[] = [];
  const server = (server: View["server"]): void => {
    server.when(/imgeo-animation-/, { status: 503 });
  };
  const site = siteOfX3d("failing-animation", animatedNodes);
  await withPage(site, { server, expectedErrors: /503/ }, async (view) => {
    view.page.on("console", (message) => {
      if (message.type() === "warning" && message.text().startsWith("imgeo:")) warnings.push(message.text());
    });
    await view.promise("complete");
    await until("there is a warning", () => warnings.length > 0);
    await settle(view.page);
    assert.equal(warnings.length, 1, warnings.join("\n"));
    assert.match(warnings[0]!, /the module that animates the scene could not be loaded: .*imgeo-animation-/);
    for (const type of ["first-image", "load"]) assert.equal((await view.events(type, "x3d")).length, 1);
    assert.deepEqual(await view.events("error"), []);
  });
});

test("a part that cannot be loaded is one error, then the scene is complete; the next change tries again", async () => {
  const site = siteOfX3d("failing-part", "<Shape><Box/></Shape>");
  await withPage(site, { expectedErrors: /503|could not be loaded/ }, async (view) => {
    await view.promise("complete");
    const allow = view.server.when(/imgeo-extensions-/, { status: 503 });
    const isComplete = (): Promise<boolean> =>
      view.page.evaluate(() => {
        const { complete } = document.querySelector("x3d") as unknown as { complete: Promise<unknown> };
        return Promise.race([complete.then(() => true), new Promise<boolean>((end) => setTimeout(end, 50, false))]);
      });
    await view.page.evaluate(() => {
      const material = '<physicalmaterial><clearcoatmaterialextension clearcoat="1"></clearcoatmaterialextension>';
      const shape = `<shape><appearance>${material}</physicalmaterial></appearance><box></box></shape>`;
      document.querySelector("scene")?.insertAdjacentHTML("beforeend", shape);
    });
    await until("the module is requested", () => view.server.requestsOf(/imgeo-extensions-/).length > 0);
    assert.ok(!(await isComplete()), "the scene is complete while a module is being loaded");
    await view.promise("complete");
    const errors = await view.events("error", "x3d");
    assert.deepEqual(
      errors.map(({ detail }) => [detail.type, detail.url]),
      [["network", ""]],
    );
    await settle(view.page);
    assert.equal(view.server.requestsOf(/imgeo-extensions-/).length, 3);
    allow();
    await view.page.evaluate(() => {
      document.querySelector("physicalmaterial")?.setAttribute("roughness", "0.5");
    });
    await until("the second shape is displayed", async () => (await view.events("first-image", "shape")).length === 2);
    await view.promise("complete");
    assert.equal((await view.events("error", "x3d")).length, 1);
  });
});

soakTest(
  "a page with text and a box loads the modules for these with the runtime, and those of changes when they come",
  async () => {
    const site = siteOfX3d("words", "<Shape><Text string='\"words\"'/></Shape><Shape><Box/></Shape>");
    await withPage(site, {}, async (view) => {
      await view.promise("complete");
      const loaded = ["imgeo", "imgeo-files", "imgeo-geometry", "imgeo-scene", "imgeo-shared"];
      assert.deepEqual(namesOf(modulesOf(view)), loaded);
      await view.page.evaluate(() => {
        const shape =
          '<shape><appearance><physicalmaterial><clearcoatmaterialextension clearcoat="1"></clearcoatmaterialextension>';
        document
          .querySelector("scene")
          ?.insertAdjacentHTML("beforeend", shape + "</physicalmaterial></appearance><box></box></shape>");
      });
      await view.page.waitForFunction(() =>
        performance.getEntriesByType("resource").some(({ name }) => name.includes("imgeo-extensions")),
      );
      await settle(view.page);
      assert.deepEqual(namesOf(modulesOf(view)), [...loaded, "imgeo-extensions"].sort());
    });
  },
);
