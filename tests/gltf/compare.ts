// Draws a glTF file with imgeo and with three.js' GLTFLoader, from the same camera and with the same lights.

import { readFileSync, readdirSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { build } from "esbuild";
import type { Browser, Page } from "playwright-core";
import { repository } from "../browser/paths.ts";
import type { TestServer } from "../browser/server.ts";
import type { CameraView } from "./threePage.ts";

export const size = { width: 320, height: 240 };

const draco = join(repository, "node_modules/three/examples/jsm/libs/draco/gltf");

/** Puts three.js' page on the server. */
export async function serveThree(server: TestServer): Promise<void> {
  server.contentPolicy = "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:";
  const bundle = await build({
    entryPoints: [join(import.meta.dirname, "threePage.ts")],
    bundle: true,
    format: "esm",
    write: false,
    target: "es2022",
  });
  server.put("/three.js", Buffer.from(bundle.outputFiles[0]?.contents ?? []));
  server.put(
    "/three.html",
    `<!doctype html><style>body { margin: 0; overflow: hidden }</style><script type="module" src="/three.js"></script>`,
  );
  for (const file of readdirSync(draco)) server.put(`/draco/${file}`, readFileSync(join(draco, file)));
}

/** Replaces the lights, background and camera of a document by those of three.js' page. */
function withCameraAndLights(page: string, { position, orientation, fieldOfView }: CameraView): string {
  const own = `<NavigationInfo headlight="false"></NavigationInfo><Background skyColor="0.9294 0.9294 0.949"></Background>
    <Viewpoint position="${position.join(" ")}" orientation="${orientation.join(" ")}" fieldOfView="${String(fieldOfView)}" set_bind="true"></Viewpoint>
    <DirectionalLight direction="-0.45 -0.8 -0.6" intensity="1" color="1 1 1" ambientIntensity="0.2" global="true"></DirectionalLight>`;
  return page
    .replace(
      /<(DirectionalLight|PointLight|SpotLight|Viewpoint|OrthoViewpoint|NavigationInfo|Background)\b[^>]*><\/\1>/g,
      "",
    )
    .replace(/<Scene>/i, `<Scene>${own}`);
}

export interface Pictures {
  readonly imgeo: Buffer;
  readonly three: Buffer;
}

/** The pictures, or that of imgeo alone with three.js' error. */
export type Drawn = Pictures | { readonly imgeo: Buffer; readonly threeError: string };

/** Both pictures. `site`: the directory of the file's site, a child of the server's directory. */
export async function draw(browser: Browser, server: TestServer, file: string, site: string): Promise<Drawn> {
  for (const other of readdirSync(dirname(file)))
    if (/\.(gltf|glb|bin|png|jpe?g|webp)$/i.test(other))
      server.put(`/model/${encodeURIComponent(other)}`, readFileSync(join(dirname(file), other)));
  const three = await drawWithThree(browser, server, file);
  if (three instanceof Error)
    return { imgeo: await drawSite(browser, server, site), threeError: three.message.split("\n")[0] ?? "" };
  return { imgeo: await drawSite(browser, server, site, three.camera), three: three.picture };
}

/** The picture and the camera of GLTFLoader's scene, or the error of GLTFLoader. */
async function drawWithThree(
  browser: Browser,
  server: TestServer,
  file: string,
): Promise<{ readonly picture: Buffer; readonly camera: CameraView } | Error> {
  const page = await newPage(browser);
  await page.goto(`${server.origin}three.html`);
  await page.waitForFunction(() => "drawModel" in window);
  try {
    const camera = await page
      .evaluate(async (url) => await window.drawModel(url), `/model/${encodeURIComponent(basename(file))}`)
      .catch((error: unknown) => {
        if (!browser.isConnected()) throw error;
        return error as Error;
      });
    return camera instanceof Error ? camera : { picture: await page.screenshot(), camera };
  } finally {
    await page.close();
  }
}

/** The picture of a site, from a camera and with the lights of three.js' page, or as it is. */
async function drawSite(browser: Browser, server: TestServer, site: string, camera?: CameraView): Promise<Buffer> {
  const path = basename(site);
  const text = readFileSync(join(site, "index.html"), "utf8");
  server.put(`/${path}/sheet.html`, camera ? withCameraAndLights(text, camera) : text);
  const page = await newPage(browser);
  try {
    await page.goto(`${server.origin}${path}/sheet.html`);
    await page.waitForFunction(() => customElements.get("imgeo-view") !== undefined);
    await page.evaluate(async () => {
      await (document.querySelector("x3d") as unknown as { complete: Promise<void> }).complete;
    });
    await page.waitForTimeout(300);
    return await page.screenshot();
  } finally {
    await page.close();
  }
}

async function newPage(browser: Browser): Promise<Page> {
  return await browser.newPage({ viewport: size, reducedMotion: "reduce" });
}
