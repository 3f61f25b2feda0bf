// Runs every block of docs/embedding.md as it stands, in a page beside the converted folder; and moves, repeats, adds
// and removes what they embed.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import type { ViewerElement } from "../../web/src/dom/index.ts";
import { assertSamePicture } from "./compare.ts";
import { finalPicture, pictureOfSite, until, withPage, type View } from "./harness.ts";
import { meshFile, siteOf, siteOfGenerated, variantOf } from "./sites.ts";
import { outputDirectory, repository, converter } from "./paths.ts";
import type { Picture } from "./png.ts";
import { startServer, type TestServer } from "./server.ts";
import { soakTest } from "./soak.ts";

const blocks = Array.from(
  readFileSync(join(repository, "docs/embedding.md"), "utf8").matchAll(/^```(\w+)\n(.*?)^```$/gms),
  ([, language = "", text = ""]) => ({ language, text }),
);

/** The only block of docs/embedding.md in this language that contains these words. */
function blockWith(language: string, words: string): string {
  const found = blocks.filter((block) => block.language === language && block.text.includes(words));
  assert.equal(found.length, 1, `docs/embedding.md has ${found.length} blocks with ${words}`);
  used.add(found[0]!.text);
  return found[0]!.text;
}
const used = new Set<string>();

/** A folder with the converted `statue/`, as the document's first block makes it, and nothing else. */
function folderWithStatue(): string {
  const folder = join(outputDirectory, "embedding");
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  cpSync(meshFile("trefoil-large"), join(folder, "statue.ply"));
  const [program, ...words] = blockWith("sh", "convert").trim().split(" ");
  assert.equal(program, "imgeo");
  execFileSync(converter, words, { cwd: folder, stdio: ["ignore", "ignore", "inherit"] });
  return folder;
}

const folder = folderWithStatue();

/** A page with `body`, in which viewers fill the window. */
function pageWith(body: string, head = ""): string {
  return `<!doctype html><html lang="en"><meta charset="utf-8"><title>A tour</title>${head}<link rel="stylesheet" href="tour.css"><body>${body}</body></html>`;
}

const fillingStyle =
  "html, body { margin: 0; height: 100% } body > x3d, imgeo-viewer { height: 100%; aspect-ratio: auto }";

function putTour(server: TestServer, body: string, path = "/tour.html", head = ""): void {
  server.put(path, pageWith(body, head));
  server.put(join(dirname(path), "tour.css"), fillingStyle);
}

/** The final picture. */
async function pictureOf(view: View, selector: string): Promise<Picture> {
  await view.promise("complete", selector);
  return view.picture();
}

/** What the site's own page shows. */
const ownPicture = (): Promise<Picture> => pictureOfSite(join(folder, "statue"));

test("the two lines that convert prints show in another page what the site's own page shows", async () => {
  const body = blockWith("html", '<imgeo-viewer src="statue/">');
  const printed = execFileSync(converter, ["convert", "statue.ply", "-o", "statue", "--json"], { cwd: folder });
  assert.equal(`${(JSON.parse(String(printed)) as { embed: string }).embed}\n`, body);
  await withPage(
    folder,
    {
      path: "tour.html",
      server: (server) => {
        putTour(server, body);
      },
    },
    async (view) => {
      assertSamePicture("one line", await pictureOf(view, "imgeo-viewer"), await ownPicture(), { mean: 0.001 });
      assert.equal(
        view.requestedPaths.filter((path) => path.endsWith(".x3d")).length,
        1,
        "the document is fetched once",
      );
      assert.equal(
        await view.page.getByRole("application", { name: "statue" }).count(),
        1,
        "it has the document's title",
      );
      // Sizes without any style of the page.
      const ratio = await view.page.evaluate(() => {
        document.querySelector("link")!.remove();
        const { width, height } = document.querySelector("imgeo-viewer")!.getBoundingClientRect();
        return width / height;
      });
      assert.ok(Math.abs(ratio - 4 / 3) < 0.01, `${ratio}`);
    },
  );
});

test("the Inline of the document shows the same scene, with the page's attributes and hotspots", async () => {
  const body = blockWith("html", "<inline");
  const options = {
    path: "a/b/tour.html",
    server: (server: TestServer) => {
      putTour(server, body, "/a/b/tour.html", '<base href="../../">');
      server.put("/tour.css", fillingStyle);
    },
  };
  await withPage(folder, options, async (view) => {
    const picture = await pictureOf(view, "x3d");
    const { data, channels } = picture;
    // The Background of the document, and a shape in front of it.
    const background = Array.from((await ownPicture()).data.subarray(0, 3));
    assert.deepEqual(Array.from(data.subarray(0, 3)), background);
    const covered = Array.from({ length: data.length / channels }, (_, i) => i * channels).filter(
      (at) => Math.abs(data[at]! - background[0]!) > 30,
    ).length;
    assert.ok(covered > 0.05 * (data.length / channels), "nothing is displayed");
    assert.equal(await view.page.getByRole("button", { name: "The hand" }).count(), 1);
    assert.equal(await view.page.getByRole("application", { name: "Marble statue of a rider" }).count(), 1);
  });
});

test("a viewer in a shadow root has its size and shows the site, and so in another one", async () => {
  const server = (host: TestServer) => {
    const component = '<template shadowrootmode="open"><imgeo-viewer src="statue/"></imgeo-viewer></template>';
    putTour(
      host,
      `<script type="module" src="statue/runtime/imgeo.js"></script><div id="a">${component}</div><div id="b"></div>`,
    );
  };
  await withPage(folder, { path: "tour.html", size: { width: 640, height: 480 }, server }, async ({ page }) => {
    const shown = async (id: string) => {
      await until("the viewer has its members", () =>
        page.evaluate((host) => {
          const viewer = document.getElementById(host)!.shadowRoot!.querySelector<ViewerElement>("imgeo-viewer")!;
          return viewer.statistics !== undefined;
        }, id),
      );
      return page.evaluate(async (host) => {
        const viewer = document.getElementById(host)!.shadowRoot!.querySelector<ViewerElement>("imgeo-viewer")!;
        await viewer.complete;
        const { width, height } = viewer.getBoundingClientRect();
        return { width, height, isDrawn: viewer.statistics!.drawCalls > 0, children: viewer.children.length };
      }, id);
    };
    const expected = { width: 640, height: 480, isDrawn: true, children: 1 };
    assert.deepEqual(await shown("a"), expected);
    await page.evaluate(() => {
      const viewer = document.getElementById("a")!.shadowRoot!.querySelector("imgeo-viewer")!;
      document.getElementById("b")!.attachShadow({ mode: "open" }).append(viewer);
    });
    assert.deepEqual(await shown("b"), expected);
  });
});

/** A page with a viewer that requires Trusted Types, and allows this policy alone. */
const requiringTrustedTypes = (allowed: string) => (server: TestServer) => {
  const directives = ["require-trusted-types-for 'script'", `trusted-types ${allowed}`, "report-uri /report"];
  server.contentPolicy = ["default-src 'self'", ...directives].join("; ");
  putTour(server, blockWith("html", '<imgeo-viewer src="statue/">'));
};

test("a page that requires Trusted Types and allows the policy imgeo displays a viewer, decoded by workers", async () => {
  await withPage(folder, { path: "tour.html", server: requiringTrustedTypes("imgeo") }, async (view) => {
    const picture = await pictureOf(view, "imgeo-viewer");
    assertSamePicture("trusted types", picture, await ownPicture(), { mean: 0.001 });
    assert.ok(view.page.workers().length > 0, "workers have been started");
    assert.deepEqual(view.server.requestsOf(/report/), []);
  });
});

soakTest("a viewer has one error where a page requires Trusted Types and does not allow the policy imgeo", async () => {
  const options = { path: "tour.html", server: requiringTrustedTypes("another"), expectedErrors: /Trusted|404/ };
  await withPage(folder, options, async (view) => {
    await view.promise("complete", "imgeo-viewer");
    assert.match(JSON.stringify(await view.events("error", "x3d")), /^\[[^[]*TrustedHTML[^[]*\]$/);
  });
});

test("a script adds a viewer, points it to another scene, removes it and adds it again", async () => {
  cpSync(siteOfGenerated("sphere"), join(folder, "sphere"), { recursive: true });
  const server = (host: TestServer) => {
    putTour(
      host,
      '<script type="module" src="statue/runtime/imgeo.js"></script><script type="module" src="tour.js"></script>',
    );
    host.put("/tour.js", blockWith("js", "createElement"));
  };
  await withPage(folder, { path: "tour.html", server }, async (view) => {
    const { page } = view;
    await view.promise("complete", "imgeo-viewer");
    const state = () =>
      page.evaluate(() => {
        const viewer = document.querySelector<ViewerElement>("imgeo-viewer")!;
        return {
          theta: viewer.getCameraOrbit().theta,
          draws: viewer.statistics?.drawCalls,
          radius: viewer.getCameraOrbit().radius,
          children: viewer.children.length,
        };
      });
    const statue = await state();
    assert.ok(Math.abs(statue.theta - Math.PI / 6) < 1e-6 && statue.draws === 2, JSON.stringify(statue));
    await page.evaluate(() => {
      const viewer = document.querySelector<ViewerElement>("imgeo-viewer")!;
      viewer.addEventListener("load", () => {
        viewer.dataset.loads = `${Number(viewer.dataset.loads ?? 0) + 1}`;
      });
      viewer.src = "sphere";
    });
    await until("the other scene has loaded", async () =>
      page.evaluate(() => document.querySelector<HTMLElement>("imgeo-viewer")!.dataset.loads !== undefined),
    );
    assert.ok((await state()).radius < statue.radius / 2, "the camera is at the other scene's viewpoint");
    await page.evaluate(async () => {
      const viewer = document.querySelector<ViewerElement>("imgeo-viewer")!;
      viewer.remove();
      await new Promise(requestAnimationFrame);
      if (viewer.statistics !== undefined) throw new Error("it still displays");
      document.body.append(viewer, viewer.cloneNode(true));
    });
    await view.promise("complete", "imgeo-viewer");
    await view.promise("complete", "imgeo-viewer + imgeo-viewer");
    assert.deepEqual(
      await page.evaluate(() =>
        Array.from(document.querySelectorAll<ViewerElement>("imgeo-viewer"), ({ children, statistics }) => [
          children.length,
          statistics?.drawCalls,
        ]),
      ),
      [
        [1, 1],
        [1, 1],
      ],
    );
  });
});

soakTest("two sites in one page, each with its own script, are displayed by one runtime", async () => {
  const body = blockWith("html", '<imgeo-viewer src="statue/">');
  const server = (host: TestServer) => {
    putTour(host, body + body.replaceAll("statue/", "sphere/"));
  };
  await withPage(folder, { path: "tour.html", server }, async (view) => {
    await view.promise("complete", "imgeo-viewer");
    await view.promise("complete", "imgeo-viewer ~ imgeo-viewer");
    assert.equal(view.requestedPaths.filter((path) => path.includes("imgeo-scene-")).length, 1);
  });
});

/** A converted scene with a textured wall in a document of its own. */
function worldWithParts(): string {
  const source = join(outputDirectory, "embedded-world");
  mkdirSync(join(source, "parts"), { recursive: true });
  writeFileSync(join(source, "parts/red.png"), redPixel);
  writeFileSync(
    join(source, "parts/wall.x3d"),
    `<X3D version="4.0"><Scene><Shape><Appearance><UnlitMaterial/><ImageTexture url='"red.png"'/></Appearance>
    <IndexedFaceSet solid="false" coordIndex="0 1 2 3 -1"><Coordinate point="-2 -2 0 2 -2 0 2 2 0 -2 2 0"/></IndexedFaceSet></Shape></Scene></X3D>`,
  );
  writeFileSync(
    join(source, "world.x3d"),
    `<X3D version="4.0"><Scene><Background skyColor="0 0 1"/><Viewpoint position="0 0 12"/><Inline url='"parts/wall.x3d"'/></Scene></X3D>`,
  );
  return siteOf(join(source, "world.x3d"));
}

const redPixel = Buffer.from(
  "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC",
  "base64",
);

test("a site of another server is displayed, with its textures and its own inlined documents", async () => {
  cpSync(worldWithParts(), join(folder, "world"), { recursive: true });
  const body = blockWith("html", "https://models.example/");
  const foreign = await startServer(folder);
  try {
    foreign.when(/./, { headers: { "Access-Control-Allow-Origin": "*" } });
    const server = (host: TestServer) => {
      host.contentPolicy = "";
      putTour(
        host,
        body.replaceAll("https://models.example/", foreign.origin) +
          `<imgeo-viewer src="${foreign.origin}world/"></imgeo-viewer>`,
      );
    };
    await withPage(folder, { path: "tour.html", server, isCrossOrigin: true }, async (view) => {
      assertSamePicture("another server", await pictureOf(view, "imgeo-viewer"), await ownPicture(), { mean: 0.001 });
      await view.promise("complete", "imgeo-viewer ~ imgeo-viewer");
      await view.page.evaluate(() => {
        document.querySelector("imgeo-viewer")!.remove();
      });
      const { data, width, height, channels } = await view.picture();
      const colorAt = (x: number, y: number) => Array.from(data.subarray((y * width + x) * channels).subarray(0, 3));
      assert.deepEqual(colorAt(width / 2, height / 2), [255, 0, 0], "the texture of the inlined document");
      assert.deepEqual(colorAt(5, height / 2), [0, 0, 255], "the background of the site's document");
      assert.deepEqual(view.requestedPaths.sort(), ["tour.css", "tour.html"]);
    });
  } finally {
    await foreign.close();
  }
});

test("colours of values are displayed as the document says", async () => {
  const attributes = /<Shape (.*)>/.exec(blockWith("html", "colorBy"))?.[1] ?? "";
  const source = join(outputDirectory, "field.ply");
  const mesh = readFileSync(meshFile("trefoil-numbers"), "latin1");
  writeFileSync(source, mesh.replace("property float height", "property float temperature"), "latin1");
  const site = siteOf(source, "--keep-attributes", "temperature");
  const colored = variantOf(site, "as-documented", (page) => page.replace("<Shape ", `<Shape ${attributes} `));
  const { data, channels } = await finalPicture(colored);
  const reddish = Array.from({ length: data.length / channels }, (_, i) => i * channels).filter(
    (at) => Math.abs(data[at]! - data[at + 2]!) > 60,
  );
  assert.ok(reddish.length > 1000, `${reddish.length} coloured pixels`);
});

test("every block of the document has been run", () => {
  assert.deepEqual(
    blocks.filter(({ text }) => !used.has(text)).map(({ text }) => text),
    [],
  );
});
