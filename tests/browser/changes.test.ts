// Tests that changes of the document change the picture, which then equals that of a page that had the same content
// from the start.

import assert from "node:assert/strict";
import { cpSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { assertSamePicture, difference } from "./compare.ts";
import { finalPicture, settle, until, withPage, type View } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import type { Picture } from "./png.ts";
import { coveragesOf, recordFrames, startRecording } from "./recordedFrames.ts";
import { gate, type TestServer } from "./server.ts";
import { ranksOfFiles } from "./siteDecoder.ts";
import { pageOf, shapeIn, siteOfGenerated, withShapes } from "./sites.ts";
import { soakTest } from "./soak.ts";

/** A site of a trefoil inside a Transform, with the files of a sphere in other/. */
function twoMeshSite(): string {
  const directory = join(outputDirectory, "sites", "changes");
  cpSync(siteOfGenerated("trefoil", "--profile", "classic"), directory, { recursive: true });
  cpSync(siteOfGenerated("sphere", "--profile", "classic"), join(directory, "other"), { recursive: true });
  return directory;
}

const inTransform = (html: string): string =>
  withShapes(html, (shape) => `<Transform id="transform">${shape}</Transform>`);

/** The sphere's Shape, its files in other/. */
function sphereShape(): string {
  const html = pageOf(siteOfGenerated("sphere", "--profile", "classic"));
  const shape = shapeIn(html).replace(/<Shape/i, `<Shape id="sphere"`);
  return [...ranksOfFiles(html).keys()].reduce((text, url) => text.replaceAll(url, `other/${url}`), shape);
}

/** The scene of the page as text, without the runtime's elements. */
async function sceneText(view: View): Promise<string> {
  return view.page.evaluate(() => {
    const copy = document.querySelector("x3d")!.cloneNode(true) as Element;
    copy.querySelector("imgeo-view")?.remove();
    return copy.outerHTML;
  });
}

async function freshPicture(site: string, scene: string): Promise<Picture> {
  const replace = (html: Buffer): string => html.toString().replace(/<X3D[\s\S]*<\/X3D>/i, () => scene);
  return finalPicture(site, { server: (server) => server.when(/^\/$/, { replace }) });
}

type Changes = Record<string, () => void>;

/** Self-contained functions that run in the page one after the other. */
const appearanceChanges: Changes = {
  "a material's colour": () => {
    document.querySelector("material")!.setAttribute("diffuseColor", "0.9 0.2 0.1");
  },
  "a material's emissive colour": () => {
    document.querySelector("material")!.setAttribute("emissiveColor", "0 0.3 0");
  },
  "a material's gloss": () => {
    document.querySelector("material")!.setAttribute("specularColor", "0.7 0.7 0.7");
    document.querySelector("material")!.setAttribute("shininess", "0.05");
  },
  "a light": () => {
    const light = document.createElement("DirectionalLight");
    light.setAttribute("direction", "-1 -1 0");
    light.setAttribute("color", "1 0.5 0");
    document.querySelector("scene")!.append(light);
  },
  "a material's transparency": () => {
    document.querySelector("material")!.setAttribute("transparency", "0.5");
  },
  "the sky": () => {
    document.querySelector("background")!.setAttribute("skyColor", "0.1 0.2 0.4");
  },
};

const transformChanges: Changes = {
  "a transform's translation": () => {
    document.querySelector("transform")!.setAttribute("translation", "0.8 0.4 0");
  },
  "a transform's rotation": () => {
    document.querySelector("transform")!.setAttribute("rotation", "0 1 0.2 0.9");
  },
  "a transform's scale": () => {
    document.querySelector("transform")!.setAttribute("scale", "0.6 0.9 0.7");
  },
  "a viewpoint": () => {
    document.querySelector("viewpoint")!.setAttribute("orientation", "0 0 1 0.4");
    document.querySelector("viewpoint")!.setAttribute("fieldOfView", "1.1");
  },
  "a shape below another transform": () => {
    const other = document.createElement("Transform");
    other.setAttribute("scale", "1.5 1.5 1.5");
    document.querySelector("scene")!.append(other);
    other.append(document.querySelector("shape")!);
  },
};

const vertexChanges: Changes = {
  "the decode box": () => {
    document.querySelector("imagegeometry")!.setAttribute("size", "3 6 4");
  },
  "removed normals": () => {
    document.querySelector("geometrypatch")!.removeAttribute("normal");
  },
};

/** Self-contained functions that hide the shape and make it visible again. */
const waysToHide: Record<string, readonly [hide: () => void, show: () => void]> = {
  "a shape": [
    () => {
      document.querySelector("shape")!.setAttribute("visible", "false");
    },
    () => {
      document.querySelector("shape")!.removeAttribute("visible");
    },
  ],
  "a group, by X3DOM's attribute": [
    () => {
      document.querySelector("transform")!.setAttribute("render", "false");
    },
    () => {
      document.querySelector("transform")!.setAttribute("render", "true");
    },
  ],
  "a switch around it": [
    () => {
      const choice = document.createElement("Switch");
      document.querySelector("scene")!.append(choice);
      choice.append(document.querySelector("transform")!);
    },
    () => {
      document.querySelector("switch")!.setAttribute("whichChoice", "0");
    },
  ],
};

describe("a change of the document changes the picture", () => {
  const replace = (html: Buffer): string => inTransform(html.toString());
  const withTransform = (use: (view: View) => Promise<void>, site = twoMeshSite()): Promise<void> =>
    withPage(site, { server: (server) => server.when(/^\/$/, { replace }) }, async (view) => {
      await view.promise("complete");
      await use(view);
    });

  for (const [what, changes, site] of [
    ["of appearance", appearanceChanges, twoMeshSite],
    ["of transforms", transformChanges, twoMeshSite],
    ["of vertices", vertexChanges, twoMeshSite],
    [
      "of transforms and appearance, with the encoding compact",
      { ...transformChanges, ...appearanceChanges },
      () => siteOfGenerated("trefoil", "--profile", "compact", "--patch-vertices", "1000"),
    ],
  ] as const) {
    (what === "of appearance" ? test : soakTest)(
      `${what}, each at once, and all together as if the page had been written so`,
      async () => {
        await withTransform(async (view) => {
          const requestCount = view.server.requests.length;
          let before = await view.picture();
          for (const [name, change] of Object.entries(changes)) {
            await view.page.evaluate(change);
            const after = await view.picture();
            assert.ok(difference(before, after).mean > 0.5, `${name}: nothing has changed`);
            before = after;
          }
          assert.equal(view.server.requests.length, requestCount, "files were requested again");
          assertSamePicture(`changed ${what}`, before, await freshPicture(site(), await sceneText(view)), {
            mean: 0.001,
          });
        }, site());
      },
    );
  }

  soakTest("that hides shapes and makes them visible again", async () => {
    await withTransform(async (view) => {
      const requestCount = view.server.requests.length;
      const shown = await view.picture();
      for (const [name, [hide, show]] of Object.entries(waysToHide)) {
        await view.page.evaluate(hide);
        const { data, channels } = await view.picture();
        assert.ok(
          data.every((byte, at) => byte === data[at % channels]),
          `${name}: something is visible`,
        );
        await view.page.evaluate(show);
        assertSamePicture(`shown again ${name}`, await view.picture(), shown, { mean: 0 });
      }
      assert.equal(view.server.requests.length, requestCount, "files were requested again");
    });
  });

  soakTest("of the files that a geometry references: the old mesh stays until the new one is whole", async () => {
    const { closed, open } = gate();
    const rules = (server: TestServer): void => {
      server.when(/^\/$/, { replace });
      server.when(/^\/other\//, { hold: closed });
      server.when(/^\/missing\//, { status: 404 });
    };
    const expectedErrors = /404|missing/;
    await withPage(twoMeshSite(), { server: rules, before: recordFrames, expectedErrors }, async (view) => {
      await view.promise("complete");
      const before = await view.picture();
      await startRecording(view);
      const original = await geometryOf(view);
      await setGeometry(view, sphereShape());
      await until("its files are requested", () => view.server.requestsOf(/^\/other\//).length > 0);
      // Only the progress bar is new.
      assertSamePicture("while the files are on their way", await view.picture(), before, { mean: 0.2 });
      const firstImages = await view.events("first-image", "shape");
      open();
      await view.promise("complete", "shape");
      const after = await view.picture();
      assert.ok(difference(before, after).mean > 0.5, "nothing has changed");
      assertSamePicture("changed files", after, await freshPicture(twoMeshSite(), await sceneText(view)), {
        mean: 0.001,
      });
      assert.equal((await view.events("first-image", "shape")).length, firstImages.length + 1);

      // A geometry that changes again before it is whole has displayed nothing.
      for (let n = 0; n < 3; ++n) {
        await setGeometry(view, original);
        await setGeometry(view, sphereShape());
      }
      await setGeometry(view, original);
      await view.promise("complete", "shape");
      assertSamePicture("changed back", await view.picture(), before, { mean: 0 });

      const isRejected = setGeometry(view, sphereShape().replaceAll("other/", "missing/")).then(() =>
        view.page.evaluate(() =>
          (document.querySelector("shape") as unknown as { complete: Promise<unknown> }).complete.then(
            () => false,
            () => true,
          ),
        ),
      );
      assert.ok(await isRejected, "the promise has resolved although files are missing");
      assertSamePicture("no file could be used", await view.picture(), before, { mean: 0 });
      const errors = await view.events("error", "shape");
      assert.ok(errors.length > 0 && errors.every(({ detail }) => (detail as { type: string }).type === "http"));

      await setGeometry(view, sphereShape());
      await view.promise("complete", "shape");
      assertSamePicture("after an error", await view.picture(), after, { mean: 0 });
      const coverages = await coveragesOf(view);
      assert.ok(coverages.length > 10 && Math.min(...coverages) > 100, `pixels covered: ${coverages.join()}`);
    });
  });

  soakTest("by an added shape and by a removed shape", async () => {
    const site = twoMeshSite();
    await withPage(site, {}, async (view) => {
      await view.promise("complete");
      const alone = await view.picture();
      const { live: before } = await view.observed();
      await addShape(view, sphereShape());
      await view.promise("complete", "#sphere");
      const both = await view.picture();
      const { live: during } = await view.observed();
      assert.ok(difference(alone, both).mean > 0.5, "the sphere is not visible");
      assert.ok(during.textures > before.textures);
      assertSamePicture("added shape", both, await freshPicture(site, await sceneText(view)), { mean: 0.001 });

      await view.page.evaluate(() => {
        document.querySelector("#sphere")!.remove();
      });
      assertSamePicture("removed shape", await view.picture(), alone, { mean: 0 });
      const { live: after } = await view.observed();
      assert.deepEqual({ ...after, programs: 0 }, { ...before, programs: 0 });
    });
  });

  test("a removed shape aborts its requests", async () => {
    const site = twoMeshSite();
    const { closed } = gate();
    await withPage(site, { server: (server) => server.when(/^\/other\//, { hold: closed }) }, async (view) => {
      await view.promise("complete");
      await addShape(view, sphereShape());
      await until("the sphere's files are requested", () => view.server.requestsOf(/^\/other\//).length > 0);
      await view.page.evaluate(() => {
        document.querySelector("#sphere")!.remove();
      });
      await until("the requests are aborted", () =>
        view.server.requestsOf(/^\/other\//).every(({ state }) => state === "aborted"),
      );
      await settle(view.page);
      const requestCount = view.server.requestsOf(/^\/other\//).length;
      await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
      assert.equal(view.server.requestsOf(/^\/other\//).length, requestCount);
      assert.deepEqual(await view.events("error"), []);
    });
  });

  test("a removed scene frees its WebGL context", async () => {
    await withPage(siteOfGenerated("trefoil", "--profile", "classic"), {}, async (view) => {
      await view.promise("complete");
      const isReleased = await view.page.evaluate(async () => {
        const context = document
          .querySelector("imgeo-view")!
          .shadowRoot!.querySelector("canvas")!
          .getContext("webgl2")!;
        document.querySelector("x3d")!.remove();
        const end = performance.now() + 20_000;
        while (!context.isContextLost() && performance.now() < end)
          await new Promise((resolve) => setTimeout(resolve, 10));
        return context.isContextLost();
      });
      assert.ok(isReleased, "the WebGL context is still held");
    });
  });
});

/** The geometry of the page's first shape. */
async function geometryOf(view: View): Promise<string> {
  return view.page.evaluate(() => document.querySelector("imagegeometry")!.outerHTML);
}

/** Gives the page's first geometry node and its patch the attributes of those in `text`, at once. */
async function setGeometry(view: View, text: string): Promise<void> {
  await view.page.evaluate((html) => {
    const other = new DOMParser().parseFromString(html, "text/html");
    for (const name of ["imagegeometry", "geometrypatch"]) {
      const [own, replacement] = [document.querySelector(name)!, other.querySelector(name)!];
      for (const attribute of [...own.getAttributeNames(), ...replacement.getAttributeNames()]) {
        const value = replacement.getAttribute(attribute);
        if (value === null) own.removeAttribute(attribute);
        else own.setAttribute(attribute, value);
      }
    }
  }, text);
}

async function addShape(view: View, shape: string): Promise<void> {
  await view.page.evaluate((text) => {
    document.querySelector("scene")!.insertAdjacentHTML("beforeend", text);
  }, shape);
}
