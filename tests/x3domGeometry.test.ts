// Holds docs/formats/x3dom-geometry.md to the fields that X3DOM's releases declare, to the runtime and to the tool:
// each row is fed to both readers of documents.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { converter } from "./browser/paths.ts";
import { encodePng } from "./browser/png.ts";
import { shapesOf } from "../web/src/document/description.ts";
import { elementsOf } from "../web/src/document/elements.testing.ts";
import { nodeFields } from "../web/src/document/nodes.ts";
import { readScene } from "../web/src/document/readScene.ts";

const root = join(import.meta.dirname, "..");

interface Row {
  readonly node: string;
  readonly field: string;
  readonly releases: string;
  readonly treatment: string;
}

const page = readFileSync(join(root, "docs/formats/x3dom-geometry.md"), "utf8");
const sections = page.split("\n## ").slice(1);
const rows: readonly Row[] = sections.flatMap((section) => {
  const [node = ""] = section.split("\n");
  return [...section.matchAll(/^\| `(\w+)` \| ([\d., ]+) \| ([\w ]+) \|/gm)].map(
    ([, field = "", releases = "", treatment = ""]) => ({ node, field, releases, treatment }),
  );
});

/** The fields that each node declares itself in a release, by its sources. */
function declaredFields(release: string): Map<string, string[]> {
  const source = readFileSync(join(root, `node_modules/x3dom-${release}/x3dom.js`), "utf8");
  const declarations = source.split("registerNodeType(").slice(1);
  return new Map(
    declarations.flatMap((declaration) => {
      const name = /^\s*["'](\w+)["']/.exec(declaration)?.[1];
      const [, body = declaration] = declaration.split("defineClass");
      const fields = body.matchAll(/addField_[SM]F\w+\(\s*(?:\w+\s*,\s*)?["'](\w+)["']/g);
      return name === undefined ? [] : [[name, Array.from(fields, ([, field = ""]) => field)] as const];
    }),
  );
}

test("the page has every field that X3DOM's releases declare, with the releases, and no other", () => {
  const documented = rows.flatMap(({ node, field, releases }) =>
    releases.split(", ").map((release) => `${release} ${node}.${field}`),
  );
  const nodes = new Set(rows.map(({ node }) => node));
  const declared = ["1.7", "1.8"].flatMap((release) =>
    Array.from(declaredFields(release)).flatMap(([node, fields]) =>
      nodes.has(node) ? fields.map((field) => `${release} ${node}.${field}`) : [],
    ),
  );
  assert.ok(declared.length > 150, "the declarations were not found");
  assert.deepEqual(documented.toSorted(), declared.toSorted());
});

test("the page has every field that convert reads of a PopGeometry", () => {
  const source = readFileSync(join(root, "src/import/x3d/pop_geometry.cpp"), "utf8");
  const call = /\b(?:integer|boolean|vec3|text|popTypeOf|attributeAt)\((?:fields, )?"(\w+)"/g;
  const read = Array.from(source.matchAll(call), ([, field = ""]) => field);
  assert.ok(read.length > 15, "the calls that read fields were not found");
  const known = new Set(rows.filter(({ node }) => /^(Pop|X3D)/.test(node)).map(({ field }) => field));
  assert.deepEqual(
    read.filter((field) => !known.has(field)),
    [],
  );
});

interface Case {
  readonly name: string;
  readonly markup: string;
}

/** The nodes of the rows of a section, in Shapes whose other fields cause no warning. */
function casesOf(title: string): Case[] {
  const section = sections.find((text) => text.startsWith(`${title}\n`)) ?? "";
  return [...section.matchAll(/^\| (\w+Geometry) \| `([^`]+)` \|/gm)].map(([, node = "", row = ""]) => {
    const url = node === "ImageGeometry" ? imageUrl : arrayUrl;
    const stated = row.replace(/"[cin]\.\w+/g, `"${url}`);
    const defaults = { coord: url, vertexCount: "3", ...(node === "ImageGeometry" && { implicitMeshSize: "3 1" }) };
    const others = Object.entries(defaults).filter(([field]) => !stated.includes(`${field}=`));
    const fields = others.map(([field, value]) => `${field}="${value}"`).join(" ");
    return { name: `${node} ${row}`, markup: `<Shape><${node} ${stated} ${fields}/></Shape>` };
  });
}

/** A square as arrays and as an image in the document, so that only the field under test can cause a warning. */
const arrayUrl = `data:application/octet-stream;base64,${Buffer.from(
  Float32Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0).buffer,
).toString("base64")}`;
const imageUrl = `data:image/png;base64,${encodePng({
  width: 3,
  height: 1,
  channels: 3,
  data: Uint8Array.of(0, 0, 0, 255, 0, 0, 255, 255, 0),
}).toString("base64")}`;
const goodImage = `<ImageGeometry coord="${imageUrl}" vertexCount="3" implicitMeshSize="3 1"/>`;
const goodArrays = `<BinaryGeometry coord="${arrayUrl}" vertexCount="3"/>`;
const withAttribute = (attribute: string, attrib = "") =>
  `<Shape><BinaryGeometry coord="${arrayUrl}" vertexCount="3" attrib="${attrib}"><FloatVertexAttribute ${attribute}/></BinaryGeometry></Shape>`;
const withImages = (images: string) =>
  `<Shape><ImageGeometry vertexCount="3" implicitMeshSize="3 1">${images}</ImageGeometry></Shape>`;

const refusedValues: readonly Case[] = [
  ...casesOf("Refused values"),
  { name: "without coordinates", markup: "<Shape><BinaryGeometry vertexCount='3'/></Shape>" },
  { name: "USE of nothing", markup: "<Shape><ImageGeometry USE='missing'/></Shape>" },
  { name: "USE of no box", markup: "<Shape><Box USE='missing'/></Shape>" },
  { name: "movie", markup: withImages('<MovieTexture containerField="coord" url="m.webm"/>') },
  { name: "USE of no image", markup: withImages('<ImageTexture containerField="coord" USE="missing"/>') },
  { name: "empty image", markup: withImages('<img containerField="coord"/>') },
  { name: "attribute without a name", markup: withAttribute('numComponents="1"', arrayUrl) },
  { name: "five components", markup: withAttribute('name="a" numComponents="5"', arrayUrl) },
  { name: "attribute without a file", markup: withAttribute('name="a" numComponents="1"') },
  { name: "range of two numbers", markup: withAttribute('name="a" numComponents="1" valueMin="1 2"', arrayUrl) },
];

const warnedValues: readonly Case[] = [
  ...casesOf("Values with a warning"),
  { name: "two geometries in files", markup: `<Shape>${goodImage}${goodArrays}</Shape>` },
  { name: "two geometries", markup: `<Shape><Box/>${goodImage}<Sphere/></Shape>` },
  {
    name: "image without a field",
    markup: withImages(
      `<ImageTexture containerField="coord" url="${imageUrl}"/><ImageTexture containerField="colour" url="${imageUrl}"/>`,
    ),
  },
  {
    name: "normals that are a movie",
    markup: withImages(
      `<ImageTexture containerField="coord" url="${imageUrl}"/><MovieTexture containerField="normal" url="m.webm"/>`,
    ),
  },
];

/** The warnings of pages for a document, without what they do about it. */
function sentencesOf(markup: string): string[] {
  return warningsOf(markup).map((message) => message.replace(/; .*/, ""));
}

test("the runtime leaves out every node with a refused value, with one warning and an error", () => {
  assert.ok(refusedValues.length > 30);
  for (const { name, markup } of refusedValues) {
    const scene = readScene(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`));
    const [shape] = shapesOf(scene.root);
    assert.equal(shape?.geometry, undefined, name);
    assert.equal(scene.warnings.length, 1, name);
    assert.match(shape?.unreadableGeometry ?? "", /^<\w+> /, name);
  }
});

test("the runtime warns once of a value that it replaces", () => {
  for (const { name, markup } of warnedValues) assert.equal(warningsOf(markup).length, 1, name);
});

test("convert warns once of the same values, with the words of the runtime", () => {
  const cases = [...refusedValues, ...warnedValues];
  const warnings = convertWarningsOf(cases.map(({ markup }) => markup).join("\n"));
  for (const [line, { name, markup }] of cases.entries()) {
    const [sentence = ""] = sentencesOf(markup);
    const ofLine = warnings.filter((warning) => new RegExp(`old\\.x3d:${line + 1}(:\\d+)?: `).test(warning));
    assert.equal(ofLine.length, 1, `${name}: ${ofLine.join("; ")}`);
    assert.ok(ofLine[0]?.includes(sentence), `${name}: ${ofLine[0]} instead of ${sentence}`);
  }
});

/** A node with a patch of the test vectors of compact. */
function compactShape(vector: string, positionBits: number, vertexCount: number): string {
  const file = readFileSync(join(root, `vectors/compact-1/${vector}.png`)).toString("base64");
  return `<Shape><ImageGeometry profile="compact" data="data:image/png;base64,${file}" positionBits="${positionBits}" vertexCount="${vertexCount}"/></Shape>`;
}

test("pages and convert read compact of the bits that its files can have, 1 to 30, and refuse others", () => {
  const bits = Array.from({ length: 34 }, (_, n) => n);
  const shapes = bits.map((n) => compactShape("fine", n, 240));
  const refusal = "positionBits is no precision";
  const read = shapes.flatMap((markup, n) => (warningsOf(markup).some((text) => text.includes(refusal)) ? [] : [n]));
  assert.deepEqual(read, bits.slice(0, 31)); // 0: as where it is not stated
  const warnings = convertWarningsOf(shapes.join("\n"));
  const readByTool = bits.filter((n) => {
    const ofLine = warnings.filter((warning) => new RegExp(`old\\.x3d:${n + 1}(:\\d+)?: `).test(warning));
    assert.equal(ofLine.length, n === 30 ? 0 : 1, `${n}: ${ofLine.join("; ")}`);
    return !ofLine.some((text) => text.includes(refusal));
  });
  assert.deepEqual(readByTool, read);
});

test("with --strict, convert refuses each of these values", () => {
  const folder = mkdtempSync(join(tmpdir(), "imgeo-"));
  try {
    for (const { name, markup } of [...refusedValues.slice(-9), ...warnedValues]) {
      writeFileSync(join(folder, "old.x3d"), `<X3D><Scene>${markup}</Scene></X3D>`);
      const { status, stderr } = spawnSync(
        converter,
        ["convert", "--strict", join(folder, "old.x3d"), "-o", join(folder, "site")],
        { encoding: "utf8" },
      );
      assert.equal(status, 3, name);
      assert.ok(stderr.includes(sentencesOf(markup)[0] ?? "?"), `${name}: ${stderr}`);
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});

function warningsOf(markup: string): string[] {
  return readScene(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`)).warnings.map(({ message }) => message);
}

/** Nodes that pages read, and how a document contains them. */
const readNodes: Readonly<Record<string, (attribute: string) => string>> = {
  ImageGeometry: (attribute) => `<Shape><ImageGeometry coord="a.png" vertexCount="3" ${attribute}/></Shape>`,
  BinaryGeometry: (attribute) => `<Shape><BinaryGeometry coord="a.bin" ${attribute}/></Shape>`,
  ClipPlane: (attribute) => `<ClipPlane ${attribute}/>`,
};
const nodesWith: Readonly<Record<string, readonly string[]>> = {
  X3DGeometryNode: ["ImageGeometry", "BinaryGeometry"],
  X3DBinaryContainerGeometryNode: ["ImageGeometry", "BinaryGeometry"],
};

/** A value other than the default of every refused field. */
const strangeValues: Readonly<Record<string, string>> = {
  numTexCoordComponents: "3",
  idsPerVertex: "true",
  compressed: "true",
  cappingStrength: "2",
  cappingColor: "1 0 0",
  on: "false",
  useGeoCache: "false",
  tangent: "t.bin",
  binormal: "b.bin",
  tangentType: "Int8",
  binormalType: "Int8",
};

test("the runtime reads what the page says it reads, and warns of what it refuses, field by field", () => {
  for (const { node, field, treatment } of rows) {
    for (const name of nodesWith[node] ?? [node]) {
      const markup = readNodes[name];
      if (markup === undefined) continue; // a refused node
      const fields: Readonly<Record<string, unknown>> = nodeFields[name as keyof typeof nodeFields];
      if (treatment === "read") {
        assert.ok(field in fields, `${name}.${field}`);
        continue;
      }
      const value = strangeValues[field] ?? assert.fail(`no value for ${name}.${field}`);
      const warnings = warningsOf(markup(`${field}="${value}"`));
      assert.equal(warnings.length, treatment === "refused" ? 1 : 0, `${name}.${field}: ${warnings.join("; ")}`);
    }
  }
});

const readableNodes: Readonly<Record<string, (attribute: string) => string>> = {
  ImageGeometry: (attribute) =>
    `<Shape><ImageGeometry implicitMeshSize="3 1" vertexCount="3" ${attribute}><ImageTexture containerField="coord" url="${imageUrl}"/></ImageGeometry></Shape>`,
  BinaryGeometry: (attribute) => `<Shape><BinaryGeometry coord="${arrayUrl}" vertexCount="3" ${attribute}/></Shape>`,
  ClipPlane: (attribute) => `<ClipPlane ${attribute}/>`,
};

/** The warnings of `imgeo convert` for a document with these nodes. */
function convertWarningsOf(markup: string): string[] {
  const folder = mkdtempSync(join(tmpdir(), "imgeo-"));
  try {
    writeFileSync(join(folder, "old.x3d"), `<X3D><Scene>${markup}</Scene></X3D>`);
    const report = execFileSync(converter, ["convert", join(folder, "old.x3d"), "-o", join(folder, "site"), "--json"], {
      encoding: "utf8",
      stdio: ["ignore", "pipe", "ignore"],
    });
    return (JSON.parse(report) as { warnings: string[] }).warnings;
  } finally {
    rmSync(folder, { recursive: true });
  }
}

test("convert warns of what the page says is refused, field by field, and of nothing else", () => {
  const fields = rows.flatMap(({ node, field, treatment }) =>
    (nodesWith[node] ?? [node]).flatMap((name) => {
      const markup = readableNodes[name];
      const value = strangeValues[field];
      return markup && value && treatment !== "read" ? [{ name, field, value, treatment, markup }] : [];
    }),
  );
  const refused = sections.filter((section) => section.split("\n")[1]?.startsWith("Refused"));
  const nodes = [...refused.map((section) => section.split("\n")[0] ?? ""), "SurprisingGeometry"].filter(
    (name) => !["BufferView", "BufferAccessor", "PopGeometryLevel"].includes(name), // parts of others
  );
  const markup = [
    ...fields.map(({ field, value, markup: nodeWith }) => nodeWith(`${field}="${value}"`)),
    ...nodes.map((name) => (name === "ExternalShape" ? `<${name}/>` : `<Shape><${name}/></Shape>`)),
  ];
  const warnings = convertWarningsOf(markup.join("\n"));
  const without = (pattern: RegExp) => warnings.findIndex((warning) => pattern.test(warning));
  for (const { name, field, treatment } of fields) {
    const pattern =
      field === "compressed" ? /BinaryGeometry left out: .*compressed/ : new RegExp(`\\b${name}\\.${field} \\(`);
    assert.equal(without(pattern) >= 0, treatment === "refused", `${name}.${field}: ${warnings.join("; ")}`);
  }
  for (const name of nodes)
    assert.ok(without(new RegExp(`\\b${name}\\b.* left out`)) >= 0, `${name}: ${warnings.join("; ")}`);
  assert.ok(
    warnings.every((warning) => warning.length < 500),
    "no warning has a whole data: URL",
  );
});

test("every refused node is left out with one warning, and as the geometry of a Shape it is an error", () => {
  const refused = sections.filter((section) => section.split("\n")[1]?.startsWith("Refused"));
  const names = refused.map((section) => section.split("\n")[0] ?? "");
  assert.ok(names.length >= 9);
  for (const name of [...names, "SurprisingGeometry"]) {
    const scene = readScene(elementsOf(`<X3D><Scene><Shape><${name}/></Shape></Scene></X3D>`));
    const [shape] = shapesOf(scene.root);
    assert.equal(scene.warnings.length, 1, name);
    assert.equal(shape?.geometry, undefined);
    assert.match(shape?.unreadableGeometry ?? "", new RegExp(`^<${name}> `));
  }
  for (const name of ["ExternalShape", "BVHRefiner", "MultiPart", "DynamicLOD"]) {
    const scene = readScene(elementsOf(`<X3D><Scene><${name}><Shape><Box/></Shape></${name}></Scene></X3D>`));
    assert.deepEqual([scene.warnings.length, shapesOf(scene.root).length], [1, 0], name);
  }
});

test("the runtime and convert use the first images of a field that has too many, with one warning", () => {
  for (const [field, used] of [
    ["coord", 4],
    ["normal", 2],
    ["color", 3],
  ] as const) {
    const image = (name: string) => `<ImageTexture containerField="${name}" url="${imageUrl}"/>`;
    const images = (field === "coord" ? "" : image("coord")) + image(field).repeat(used + 1);
    const markup = `<Shape><ImageGeometry implicitMeshSize="3 1" vertexCount="3">${images}</ImageGeometry></Shape>`;
    const expected = new RegExp(`only the first ${used} of ${used + 1} ${field}`);
    for (const warnings of [warningsOf(markup), convertWarningsOf(markup)])
      assert.equal(warnings.filter((warning) => expected.test(warning)).length, 1, `${field}: ${warnings.join("; ")}`);
  }
});
