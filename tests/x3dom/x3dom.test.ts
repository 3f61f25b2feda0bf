// Compares sites of `--target x3dom` in X3DOM with the same mesh written inline into the same page: a sample of the
// cases in `make test`, all in `make soak`.

import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { assertSamePicture, difference, isWithin, savePicture, type Bounds } from "../browser/compare.ts";
import {
  areaWeightedNormals,
  readObj,
  readPly,
  trefoil,
  withTexCoords,
  writeObj,
  type PlainMesh,
} from "../browser/meshes.ts";
import { modelDirectory, outputDirectory } from "../browser/paths.ts";
import { decodePng, encodePng, type Picture } from "../browser/png.ts";
import { meshFile, pageOf, siteOf, siteOfGenerated, type GeneratedMesh } from "../browser/sites.ts";
import { soakTest } from "../browser/soak.ts";
import { referencePage } from "./referencePage.ts";
import { fileOf, pictureOf, hashOf, type Container } from "./releases.ts";

const options = (container: Container): string[] => [
  "--target",
  "x3dom",
  "--x3dom-url",
  "x3dom/",
  "--container",
  container,
  "--effort",
  "0",
];
const containers: Container[] = ["sig", "bg"];
/** Maximum differences of pictures. */
const bounds: Bounds = { mean: 0.05, offShare: 0.0001 };
const patches = ["--patch-vertices", "700"];

function sourceOf(name: GeneratedMesh): PlainMesh {
  const mesh = readPly(readFileSync(meshFile(name)));
  return mesh.normals || mesh.triangles.length === 0 ? mesh : { ...mesh, normals: areaWeightedNormals(mesh) };
}

/** An OBJ file of the mesh with a texture of smooth stripes, in a folder of its own. */
function texturedFile(name: string, mesh: PlainMesh): string {
  const folder = join(outputDirectory, name);
  mkdirSync(folder, { recursive: true });
  const wave = (x: number): number => Math.round(127.5 + 110 * Math.sin((2 * Math.PI * x) / 32));
  const data = Uint8Array.from(
    Array.from({ length: 64 * 64 }, (_, i) => {
      const [x, y] = [i % 64, Math.floor(i / 64)];
      return [wave(x), wave(2 * y), 4 * y];
    }).flat(),
  );
  writeFileSync(join(folder, "stripes.png"), encodePng({ width: 64, height: 64, channels: 3, data }));
  writeFileSync(join(folder, "stripes.mtl"), "newmtl stripes\nKd 1 1 1\nmap_Kd stripes.png\n");
  writeFileSync(join(folder, `${name}.obj`), writeObj(mesh, "stripes.mtl", "stripes"));
  return join(folder, `${name}.obj`);
}

/** Origin of a lattice, and edge length of its cube. */
interface Cube {
  readonly origin: readonly number[];
  readonly edge: number;
}

function cubeAround(mesh: PlainMesh): Cube {
  const axes = [0, 1, 2].map((axis) => mesh.positions.filter((_, i) => i % 3 === axis));
  const origin = axes.map((values) => values.reduce((a, b) => Math.min(a, b)));
  return {
    origin,
    edge: Math.max(...axes.map((values, axis) => values.reduce((a, b) => Math.max(a, b)) - (origin[axis] ?? 0))),
  };
}

/**
 * The cube that the document states in few digits; it differs from the mesh's own by less than a thousandth of a step.
 */
function statedCube(site: string): Cube {
  const [, node = ""] = /<(?:Binary|Image)Geometry([^>]*)>/.exec(pageOf(site)) ?? [];
  const numbersOf = (name: string): number[] =>
    (new RegExp(` ${name}="([^"]*)"`).exec(node)?.[1] ?? "").split(" ").map(Number);
  const edge = Math.max(...numbersOf("size"));
  return { origin: numbersOf("position").map((center) => center - edge / 2), edge };
}

/** The mesh with its positions rounded to convert's lattice. */
function onLattice(mesh: PlainMesh, bits: number, { origin, edge } = cubeAround(mesh)): PlainMesh {
  const step = edge / (2 ** bits - 1);
  const positions = mesh.positions.map((value, i) => {
    const min = origin[i % 3] ?? NaN;
    const stored = min + step * Math.round((value - min) / step);
    assert.ok(Math.abs(stored - value) < 0.51 * step, "the lattice is not the mesh's");
    return stored;
  });
  return { ...mesh, positions };
}

/** Reference pictures by mesh and release. */
const references = new Map<string, Picture>();
async function referenceOf(site: string, container: Container, name: string, mesh: PlainMesh): Promise<Picture> {
  const key = `${name} ${container}`;
  const picture = references.get(key) ?? (await pictureOf(site, container, referencePage(pageOf(site), mesh)));
  references.set(key, picture);
  return picture;
}

/** Asserts that the picture differs from the plain background. */
function assertShowsSomething(picture: Picture): void {
  const ground = { ...picture, data: Uint8Array.from(picture.data, (_, i) => picture.data[i % picture.channels] ?? 0) };
  assert.ok(difference(picture, ground).mean > 1, "the reference is empty");
}

async function assertShows(name: string, site: string, container: Container, mesh: PlainMesh): Promise<void> {
  const expected = await referenceOf(site, container, name, mesh);
  assertShowsSomething(expected);
  const actual = await pictureOf(site, container, pageOf(site));
  const found = assertSamePicture(`x3dom-${name}-${container}`, actual, expected, bounds);
  savePicture(`x3dom-${name}-${container}`, actual);
  console.log(`x3dom ${name} ${container}: mean ${found.mean.toFixed(4)}, off ${(100 * found.offShare).toFixed(4)} %`);
}

/** The cases of `make test`: each attribute of both containers in one of them. */
const sample: Record<Container, string> = {
  sig: "many patches of strips with colours",
  bg: "coordinates as uint16 beside angles and colours in many patches",
};

for (const container of containers) {
  describe(`A site for X3DOM in ${container === "sig" ? "images" : "arrays"}`, () => {
    /** With `bits` the reference's positions are on the lattice, whose steps are larger than pixels. */
    const cases: [what: string, mesh: GeneratedMesh, more: string[], bits?: number][] = [
      ["triangles", "trefoil", []],
      ["strips", "trefoil", ["--primitives", "strips"]],
      ["many patches of strips with colours", "trefoil-colors", [...patches, "--primitives", "strips"]],
      ["computed normals", "trefoil-plain", []],
    ];
    cases.push(["triangles without an index", "trefoil", ["--index", "off"]]);
    cases.push([
      "many patches of strips with colours without an index",
      "trefoil-colors",
      [...patches, "--index", "off", "--primitives", "strips"],
    ]);
    if (container === "sig") cases.push(["positions of three bytes", "sphere", ["--position-bits", "20"]]);
    if (container === "bg") {
      for (const layout of ["separate", "interleaved"]) {
        cases.push([
          `coordinates as float32, ${layout}`,
          "trefoil-colors",
          ["--coord-type", "float32", "--layout", layout],
        ]);
        cases.push([
          `coordinates as int16, ${layout}`,
          "trefoil-colors",
          ["--coord-type", "int16", "--layout", layout, "--primitives", "strips"],
          15,
        ]);
      }
      cases.push([
        "coordinates as uint16 beside angles and colours in many patches",
        "trefoil-colors",
        ["--coord-type", "uint16", "--layout", "interleaved", "--normals", "spherical", ...patches],
      ]);
      cases.push([
        "many interleaved patches without an index",
        "trefoil",
        ["--coord-type", "int16", "--layout", "interleaved", "--index", "off", ...patches],
        15,
      ]);
      cases.push(["indices of 32 bits", "trefoil-large", ["--patch-vertices", "100000"]]);
      cases.push(["normals as angles beside the coordinates", "trefoil", ["--normals", "spherical"]]);
    }
    for (const [what, mesh, more, bits] of cases) {
      (sample[container] === what ? test : soakTest)(`displays ${what} like the inline mesh`, async () => {
        const source = bits === undefined ? sourceOf(mesh) : onLattice(sourceOf(mesh), bits);
        await assertShows(
          bits === undefined ? mesh : `${mesh}-${bits}`,
          siteOfGenerated(mesh, ...options(container), ...more),
          container,
          source,
        );
      });
    }

    (container === "sig" ? test : soakTest)("displays a texture on many patches like the inline mesh", async () => {
      const mesh = withTexCoords(trefoil());
      await assertShows(
        "texture",
        siteOf(texturedFile("texture", mesh), ...options(container), ...patches),
        container,
        mesh,
      );
    });

    soakTest("displays positions of 12 bits like the inline mesh", async () => {
      const site = siteOfGenerated("sphere", ...options(container), "--position-bits", "12");
      await assertShows("sphere-12", site, container, onLattice(sourceOf("sphere"), 12));
    });

    if (container === "bg") {
      soakTest("displays a texture that repeats like the inline mesh", async () => {
        const mesh = withTexCoords(trefoil(), 3, -1);
        const records = ["--coord-type", "float32", "--layout", "interleaved"];
        await assertShows(
          "texture-repeats",
          siteOf(texturedFile("texture-repeats", mesh), ...options(container), ...records),
          container,
          mesh,
        );
      });

      soakTest("displays positions of 8 bits as uint8 and of 11 as int16 like the inline mesh", async () => {
        for (const [type, bits] of [
          ["uint8", 8],
          ["int16", 11],
        ] as const) {
          const site = siteOfGenerated(
            "sphere",
            ...options(container),
            "--coord-type",
            type,
            "--position-bits",
            `${bits}`,
          );
          await assertShows(`sphere-${bits}`, site, container, onLattice(sourceOf("sphere"), bits));
        }
      });

      soakTest("displays coloured points of interleaved bytes like the inline mesh", async () => {
        const site = siteOfGenerated(
          "points",
          ...options(container),
          "--coord-type",
          "uint8",
          "--layout",
          "interleaved",
        );
        await assertShows("points-8", site, container, onLattice(sourceOf("points"), 8, statedCube(site)));
      });
    }

    (container === "bg" ? test : soakTest)("displays coloured points like the inline mesh", async () => {
      // A point is one pixel: half a step of the lattice moves some of them to the next pixel.
      const site = siteOfGenerated("points", ...options(container));
      await assertShows("points-16", site, container, onLattice(sourceOf("points"), 16, statedCube(site)));
    });

    for (const primitives of ["triangles", "strips"]) {
      soakTest(
        `displays coloured lines as ${primitives === "strips" ? "strips" : "lines"} like the inline mesh`,
        async () => {
          const site = siteOfGenerated("coil", ...options(container), "--primitives", primitives);
          await assertShows("coil-16", site, container, onLattice(sourceOf("coil"), 16, statedCube(site)));
        },
      );
    }

    if (container === "sig") {
      soakTest("displays normals of a palette as its RGB values", async () => {
        const site = siteOfGenerated("trefoil", ...options(container), "--normals", "palette");
        const page = pageOf(site);
        const [, normals = ""] = /containerField="normal" url='"([^"]+)"'/.exec(page) ?? [];
        const expanded = encodePng(decodePng(readFileSync(join(site, normals))));
        const expected = await pictureOf(site, container, page.replace(normals, "expanded.png"), {
          "/expanded.png": expanded,
        });
        assertShowsSomething(expected);
        assertSamePicture("x3dom-palette", await pictureOf(site, container, page), expected, { mean: 0, offShare: 0 });
      });
    }

    test(
      "displays the Stanford bunny like the inline mesh",
      { skip: !existsSync(join(modelDirectory, "stanford-bunny.obj")) },
      async () => {
        const file = join(modelDirectory, "stanford-bunny.obj");
        const mesh = readObj(readFileSync(file, "utf8"));
        await assertShows("bunny", siteOf(file, ...options(container)), container, {
          ...mesh,
          normals: areaWeightedNormals(mesh),
        });
      },
    );

    (container === "bg" ? test : soakTest)("differs if two files are swapped", async () => {
      const site = siteOfGenerated("trefoil-colors", ...options(container), ...patches);
      const page = pageOf(site);
      // The second and third file: two byte planes, or coordinates and normals.
      const [, first = "", second = ""] = [...page.matchAll(/geometry\/\w+\.(?:png|bin)/g)].map(([url]) => url);
      const swapped = page.replace(first, "?").replace(second, first).replace("?", second);
      const actual = await pictureOf(site, container, swapped);
      const expected = await referenceOf(site, container, "trefoil-colors", sourceOf("trefoil-colors"));
      assert.ok(!isWithin(difference(actual, expected), bounds));
    });

    test("loads X3DOM's npm release by default", () => {
      const page = pageOf(siteOfGenerated("sphere", "--target", "x3dom", "--container", container));
      for (const name of ["x3dom.js", "x3dom.css"] as const) {
        assert.match(page, new RegExp(`https://[^"]*${name.replace(".", "\\.")}"`));
        assert.ok(page.includes(hashOf(container, name)), `${name} has another hash`);
        assert.ok(fileOf(container, name).length > 0);
      }
    });

    (container === "sig" ? test : soakTest)("displays scene.x3d in another page by Inline", async () => {
      const site = siteOfGenerated("trefoil-colors", ...options(container), ...patches, "--primitives", "strips");
      const page = pageOf(site);
      const before = page.slice(0, page.search(/<(Group|Shape)\b/)); // viewpoint, lights and ground
      const inline = `${before}<Inline url="shapes.x3d"></Inline></Scene></X3D></body></html>`;
      const shapes = readFileSync(join(site, "scene.x3d"), "utf8").replaceAll(
        /<(Viewpoint|DirectionalLight|NavigationInfo|Background)\b[\s\S]*?<\/\1>/g,
        "",
      );
      const actual = await pictureOf(site, container, inline, { "/shapes.x3d": shapes });
      const expected = await referenceOf(site, container, "trefoil-colors", sourceOf("trefoil-colors"));
      assertSamePicture(`x3dom-inline-${container}`, actual, expected, bounds);
    });
  });
}
