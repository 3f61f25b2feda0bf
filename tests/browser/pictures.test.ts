// Tests that the picture of a page equals that of plain buffers: buffers that hold the values of the container files,
// and buffers that hold the input.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import {
  assertSamePicture,
  boundsOfCompact,
  boundsOfInput,
  boundsOfQuantised,
  difference,
  isWithin,
} from "./compare.ts";
import { decodeCompactSite } from "./compactDecoder.ts";
import { finalPicture, largePictureSize, type PageOptions } from "./harness.ts";
import { readObj, readPly } from "./meshes.ts";
import { modelDirectory } from "./paths.ts";
import { decodePng, encodePng, type Picture } from "./png.ts";
import { referenceSettingsOf, patchOfInput, referencePicture } from "./reference.ts";
import { decodeSite, ranksOfFiles } from "./siteDecoder.ts";
import { meshFile, pageOf, siteOf, siteOfGenerated, type GeneratedMesh } from "./sites.ts";
import { soakTest } from "./soak.ts";

interface Case {
  mesh: GeneratedMesh;
  options: string[];
  /** Whether only `make soak` runs it: other cases, here or in cpuDecoding.test.ts, have each of its values. */
  isLong?: boolean;
}

const cases: Case[] = [
  ...["sig", "bg"].flatMap((container) =>
    ["triangles", "strips"].flatMap((primitives) => [
      {
        mesh: "trefoil" as const,
        options: ["--container", container, "--primitives", primitives],
        isLong: true,
      },
      {
        mesh: "trefoil-colors" as const,
        options: ["--container", container, "--primitives", primitives, "--patch-vertices", "1000"],
        isLong: true,
      },
    ]),
  ),
  { mesh: "trefoil-plain", options: ["--position-bits", "12"], isLong: true },
  { mesh: "trefoil-plain", options: ["--position-bits", "24"], isLong: true },
  { mesh: "trefoil-plain", options: ["--container", "bg", "--normal-bits", "16"], isLong: true },
  ...["octahedral", "spherical", "palette"].map((normals) => ({
    mesh: "trefoil" as const,
    options: ["--normals", normals, "--patch-vertices", "1000", "--primitives", "triangles"],
    isLong: normals !== "spherical",
  })),
  ...["octahedral", "spherical"].map((normals) => ({
    mesh: "trefoil-colors" as const,
    options: ["--container", "bg", "--normals", normals],
    isLong: true,
  })),
  {
    mesh: "trefoil-plain",
    options: ["--container", "bg", "--normals", "octahedral", "--normal-bits", "16"],
    isLong: true,
  },
  { mesh: "trefoil", options: ["--normals", "octahedral", "--index", "off"], isLong: true },
  ...["uint8", "int8", "int16", "float32"].flatMap((type) =>
    ["separate", "interleaved"].map((layout) => ({
      mesh: "trefoil-colors" as const,
      options: ["--container", "bg", "--coord-type", type, "--layout", layout],
      isLong: true,
    })),
  ),
  {
    mesh: "trefoil-colors",
    options: [
      ...["--container", "bg", "--coord-type", "int16", "--layout", "interleaved"],
      ...["--primitives", "strips", "--patch-vertices", "1000"],
    ],
  },
  {
    mesh: "trefoil",
    options: ["--container", "bg", "--coord-type", "int16", "--position-bits", "11", "--normals", "spherical"],
    isLong: true,
  },
  {
    mesh: "trefoil-colors",
    options: ["--container", "bg", "--layout", "interleaved", "--position-bits", "20", "--primitives", "strips"],
    isLong: true,
  },
  {
    mesh: "trefoil-colors",
    options: ["--container", "bg", "--layout", "interleaved", "--normals", "octahedral"],
    isLong: true,
  },
  { mesh: "points", options: ["--container", "bg", "--layout", "interleaved", "--coord-type", "float32"] },
  ...["sig", "bg"].map((container) => ({
    mesh: "trefoil-large" as const,
    options: ["--container", container, "--patch-vertices", "100000"],
    isLong: true,
  })),
  { mesh: "trefoil-colors", options: ["--index", "off", "--primitives", "strips"], isLong: true },
  { mesh: "trefoil-colors", options: ["--index", "off", "--container", "bg"], isLong: true },
  { mesh: "points", options: [], isLong: true },
  { mesh: "points", options: ["--container", "bg"], isLong: true },
  { mesh: "trefoil-colors", options: ["--primitives", "points"], isLong: true },
  ...["sig", "bg"].flatMap((container) => [
    { mesh: "coil" as const, options: ["--container", container], isLong: true },
    {
      mesh: "coil" as const,
      options: ["--container", container, "--primitives", "strips", "--patch-vertices", "500"],
      isLong: container === "sig",
    },
  ]),
  { mesh: "coil", options: ["--primitives", "strips", "--index", "off"], isLong: true },
];

describe("the final picture equals that of plain buffers with the quantised mesh", () => {
  for (const { mesh, options, isLong } of cases) {
    (isLong ? soakTest : test)([mesh, ...options].join(" "), async () => {
      const site = siteOfGenerated(mesh, "--profile", "classic", ...options);
      const expected = await referencePicture(pageOf(site), decodeSite(site));
      assertSamePicture(`quantised ${mesh} ${options.join("")}`, await finalPicture(site), expected, boundsOfQuantised);
    });
  }
});

// A page draws a small scene of compact by the preview's shaders (web/src/preview), which stay until something changes.
describe("the final picture of compact equals that of plain buffers with the quantised mesh", () => {
  for (const [mesh, options] of [
    ["trefoil", []],
    ["trefoil", ["--normal-bits", "12", "--patch-vertices", "1000"]],
    ["trefoil-plain", ["--position-bits", "12"]],
    ["trefoil-large", ["--patch-vertices", "20000"]],
  ] as const) {
    (mesh === "trefoil" && options.length === 0 ? test : soakTest)([mesh, ...options].join(" "), async () => {
      const site = siteOfGenerated(mesh, "--profile", "compact", ...options);
      const expected = await referencePicture(pageOf(site), decodeCompactSite(site));
      const name = `quantised compact ${mesh} ${options.join("")}`;
      assertSamePicture(name, await finalPicture(site), expected, boundsOfQuantised);
    });
  }
});

const largePicture = (site: string): Promise<Picture> => finalPicture(site, { size: largePictureSize });

describe("the final picture equals that of plain buffers with the input", () => {
  for (const mesh of ["trefoil", "trefoil-colors", "trefoil-plain"] as const) {
    for (const options of [
      ["--profile", "compact"],
      ["--profile", "classic"],
      ["--container", "bg"],
    ]) {
      const sample = mesh === (options.includes("compact") ? "trefoil-plain" : "trefoil-colors");
      (sample ? test : soakTest)([mesh, ...options].join(" "), async () => {
        const site = siteOfGenerated(mesh, ...options);
        const input = patchOfInput(readPly(readFileSync(meshFile(mesh))));
        const expected = await referencePicture(pageOf(site), [input], largePictureSize);
        const bounds = options.includes("compact") ? boundsOfCompact : boundsOfInput;
        assertSamePicture(`input ${mesh} ${options.join("")}`, await largePicture(site), expected, bounds);
      });
    }
  }

  // Closed seams show no background, and shading goes on across them.
  soakTest("trefoil --as geometry-image", async () => {
    const site = siteOfGenerated("trefoil", "--as", "geometry-image", "--grid", "320");
    const input = patchOfInput(readPly(readFileSync(meshFile("trefoil"))));
    const expected = await referencePicture(pageOf(site), [input], largePictureSize);
    assertSamePicture("input trefoil as geometry image", await largePicture(site), expected, {
      mean: 0.4,
      offShare: 0.005,
    });
  });

  const bunny = join(modelDirectory, "stanford-bunny.obj");
  for (const container of ["sig", "bg"]) {
    test(`bunny --container ${container}`, { skip: existsSync(bunny) ? false : `${bunny} is missing` }, async () => {
      const site = siteOf(bunny, "--profile", "classic", "--container", container);
      const expected = await referencePicture(
        pageOf(site),
        [patchOfInput(readObj(readFileSync(bunny, "utf8")))],
        largePictureSize,
      );
      assertSamePicture(`input bunny ${container}`, await largePicture(site), expected, boundsOfInput);
    });
  }
});

describe("a wrong mesh is detected", () => {
  async function assertDiffers(site: string, options: PageOptions): Promise<void> {
    const right = await referencePicture(pageOf(site), decodeSite(site));
    const found = difference(await finalPicture(site, options), right);
    assert.ok(!isWithin(found, boundsOfQuantised), `mean ${found.mean} passes the bound of the quantised mesh`);
    assert.ok(!isWithin(found, boundsOfInput), `mean ${found.mean}, ${found.offShare} pass the bounds of the input`);
  }

  soakTest("byte planes swapped", async () => {
    const site = siteOfGenerated("trefoil", "--profile", "classic");
    const [high, low] = [fileOfRank(site, 0), fileOfRank(site, 4)];
    const swapped = (html: Buffer): string =>
      html
        .toString()
        .replaceAll(/coord=.*/gi, (coord) => coord.replace(high, "\n").replace(low, high).replace("\n", low));
    await assertDiffers(site, { server: (server) => server.when(/^\/$/, { replace: swapped }) });
  });

  for (const container of ["sig", "bg"] as const) {
    (container === "sig" ? test : soakTest)(`one index off, ${container}`, async () => {
      const site = siteOfGenerated("trefoil", "--profile", "classic", "--container", container);
      const index = `/${fileOfRank(site, 1)}`;
      const corner = nearestCorner(site);
      const replace = container === "sig" ? otherIndexInImage(corner) : otherIndexInArray(corner);
      await assertDiffers(site, { server: (server) => server.when((path) => path === index, { replace }) });
    });
  }

  function fileOfRank(site: string, expectedRank: number): string {
    const [url] = [...ranksOfFiles(pageOf(site))].find(([, rank]) => rank === expectedRank) ?? [];
    assert.ok(url);
    return url;
  }

  /** Error of the index: four rows of a coordinate image. */
  const offBy = 1024;

  /** The corner whose wrong index makes the largest triangle that faces the camera. */
  function nearestCorner(site: string): number {
    const { positions, triangles } = decodeSite(site)[0]!;
    const eye = referenceSettingsOf(pageOf(site)).viewpoint.position;
    const spanned = (corner: number): number => {
      const vertices = [...triangles.subarray(corner - (corner % 3), corner - (corner % 3) + 3)];
      vertices[corner % 3]! ^= offBy;
      const [a, b, c] = vertices.map((vertex) => [0, 1, 2].map((axis) => positions[3 * vertex + axis]! - eye[axis]!));
      if (Math.max(...vertices) * 3 >= positions.length) return 0;
      // The signed volume of the triangle and the eye is negative if the triangle faces the eye.
      const volume = [0, 1, 2].reduce((sum, axis) => {
        const [y, z] = [(axis + 1) % 3, (axis + 2) % 3];
        return sum + a![axis]! * (b![y]! * c![z]! - b![z]! * c![y]!);
      }, 0);
      return -volume;
    };
    const areas = Array.from(triangles, (_, corner) => spanned(corner));
    return areas.indexOf(Math.max(...areas));
  }

  const otherIndexInImage =
    (corner: number) =>
    (bytes: Buffer): Buffer => {
      const image = decodePng(bytes);
      // Green is the row in units of 1/256 of the coordinate image, which is 16 rows high: 2,560 vertices.
      image.data[corner * image.channels + 1]! ^= (offBy / 256) * 16;
      return encodePng(image);
    };

  const otherIndexInArray =
    (corner: number) =>
    (bytes: Buffer): Buffer => {
      const changed = Buffer.from(bytes);
      changed.writeUInt16LE(changed.readUInt16LE(2 * corner) ^ offBy, 2 * corner);
      return changed;
    };
});
