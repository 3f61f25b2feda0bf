// Draws reference pictures with plain three.js from plain buffers in a page of its own. Camera, lights and material
// are read from the site's document; referencePage.ts draws them by X3D's equations.

import { build } from "esbuild";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { browser, pictureSize, screenshotOf } from "./harness.ts";
import { areaWeightedNormals, type PlainMesh } from "./meshes.ts";
import { outputDirectory, repository } from "./paths.ts";
import type { Picture } from "./png.ts";
import { startServer, type TestServer } from "./server.ts";
import { numbersOf, tagsOf, type PlainPatch } from "./siteDecoder.ts";

type Vec3 = [number, number, number];

/** A scene of one shape: X3D's fields and plain buffers. */
export interface ReferenceScene {
  viewpoint: { position: Vec3; orientation: [number, number, number, number]; fieldOfView: number };
  headlight: boolean;
  lights: { direction: Vec3; color: Vec3; intensity: number; ambientIntensity: number }[];
  material: {
    diffuseColor: Vec3;
    specularColor: Vec3;
    emissiveColor: Vec3;
    ambientIntensity: number;
    shininess: number;
  };
  skyColor: Vec3;
  patches: {
    positions: number[];
    normals?: number[];
    colors?: number[];
    triangles: number[];
    lines: number[];
    points: number[];
  }[];
}

/** The fields of camera, lights, material and background with which the only shape of a document is drawn. */
export function referenceSettingsOf(html: string): Omit<ReferenceScene, "patches"> {
  const tags = tagsOf(html);
  const attributesOf = (name: string): Record<string, string> =>
    tags.find((tag) => tag.name === name)?.attributes ?? {};
  const vec3 = (text: string | undefined, fallback: Vec3): Vec3 => numbersOf(text, fallback).slice(0, 3) as Vec3;
  const [viewpoint, material, background] = ["viewpoint", "material", "background"].map(attributesOf);
  return {
    viewpoint: {
      position: vec3(viewpoint!.position, [0, 0, 10]),
      orientation: numbersOf(viewpoint!.orientation, [0, 0, 1, 0]) as [number, number, number, number],
      fieldOfView: Number(viewpoint!.fieldofview ?? 0.7854),
    },
    headlight: attributesOf("navigationinfo").headlight !== "false",
    lights: tags
      .filter(({ name }) => name === "directionallight")
      .map(({ attributes }) => ({
        direction: vec3(attributes.direction, [0, 0, -1]),
        color: vec3(attributes.color, [1, 1, 1]),
        intensity: Number(attributes.intensity ?? 1),
        ambientIntensity: Number(attributes.ambientintensity ?? 0),
      })),
    material: {
      diffuseColor: vec3(material!.diffusecolor, [0.8, 0.8, 0.8]),
      specularColor: vec3(material!.specularcolor, [0, 0, 0]),
      emissiveColor: vec3(material!.emissivecolor, [0, 0, 0]),
      ambientIntensity: Number(material!.ambientintensity ?? 0.2),
      shininess: Number(material!.shininess ?? 0.2),
    },
    skyColor: vec3(background!.skycolor, [0, 0, 0]),
  };
}

/** The float input as the reference draws it: with computed normals if it has none. */
export function patchOfInput({
  positions,
  normals,
  colors,
  triangles,
  lines = new Uint32Array(0),
}: PlainMesh): PlainPatch {
  const isCloud = triangles.length + lines.length === 0;
  const drawnNormals = normals ?? (triangles.length ? areaWeightedNormals({ positions, triangles }) : undefined);
  return {
    positions,
    ...(drawnNormals && { normals: drawnNormals }),
    ...(colors && { colors: Float32Array.from(colors, (byte) => byte / 255) }),
    triangles,
    lines,
    points: Uint32Array.from({ length: isCloud ? positions.length / 3 : 0 }, (_, i) => i),
  };
}

/** A page that draws all references, because opening a page takes longer than drawing. */
interface ReferencePage {
  page: Page;
  server: TestServer;
  /** Console errors and uncaught exceptions. */
  failures: string[];
}

const referencePages = new Map<number, Promise<ReferencePage>>();
let bundled: Promise<string> | undefined;

async function bundle(): Promise<string> {
  const outfile = join(outputDirectory, "reference.js");
  await build({
    entryPoints: [join(repository, "tests/browser/referencePage.ts")],
    outfile,
    bundle: true,
    format: "esm",
    target: "es2022",
    logLevel: "warning",
  });
  return outfile;
}

async function openReferencePage(deviceScaleFactor: number): Promise<ReferencePage> {
  bundled ??= bundle();
  await bundled;
  const server = await startServer(outputDirectory);
  server.put(
    "/",
    `<!doctype html><link rel="stylesheet" href="/reference.css"><canvas></canvas><script type="module" src="/reference.js"></script>`,
  );
  server.put("/reference.css", "body { margin: 0 } canvas { display: block }");
  const page = await (await browser()).newPage({ viewport: pictureSize, deviceScaleFactor });
  page.on("close", () => void server.close());
  const failures: string[] = [];
  page.on("console", (message) => {
    if (message.type() === "error") failures.push(message.text());
  });
  page.on("pageerror", (error) => failures.push(String(error)));
  await page.goto(server.origin);
  return { page, server, failures };
}

/** The picture of plain buffers with camera, lights and material of a site's document. */
export async function referencePicture(
  html: string,
  patches: PlainPatch[],
  size = pictureSize,
  deviceScaleFactor = 1,
): Promise<Picture> {
  const opened = referencePages.get(deviceScaleFactor) ?? openReferencePage(deviceScaleFactor);
  referencePages.set(deviceScaleFactor, opened);
  const { page, server, failures } = await opened;
  const scene: ReferenceScene = { ...referenceSettingsOf(html), patches: patches.map(asArrays) };
  server.put("/scene.json", JSON.stringify(scene));
  await page.setViewportSize(size);
  await page.evaluate(() => window.drawReference("/scene.json"));
  if (failures.length) throw new Error(`the reference page failed: ${failures.splice(0).join("; ")}`);
  return screenshotOf(page);
}

function asArrays(patch: PlainPatch): ReferenceScene["patches"][number] {
  return {
    positions: [...patch.positions],
    ...(patch.normals && { normals: [...patch.normals] }),
    ...(patch.colors && { colors: [...patch.colors] }),
    triangles: [...patch.triangles],
    lines: [...patch.lines],
    points: [...patch.points],
  };
}
