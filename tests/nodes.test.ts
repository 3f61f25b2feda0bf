// Compares the three tables of nodes and fields: the converter's (vectors/nodes.json, written by
// src/documents/node_fields_test.cpp), the runtime's (web/src/document) and the tables of docs/formats/nodes.md.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import type { Field } from "../web/src/document/fieldTypes.ts";
import { nodeTypes } from "../web/src/animation/nodeTypes.ts";
import { nodeFields } from "../web/src/document/nodes.ts";

const root = join(import.meta.dirname, "..");
const read = (path: string): string => readFileSync(join(root, path), "utf8");

/** A field as a table states it; `defaultText` is in X3D's text encoding. */
interface Row {
  readonly type: string;
  readonly defaultText: string;
}
type Table = ReadonlyMap<string, Row>;

/** Documented tables by their heading, each with the nodes that it describes. */
interface Section {
  readonly nodes: readonly string[];
  readonly table: Table;
}

function documentedSections(): Map<string, Section> {
  const sections = new Map<string, Section>();
  const text = read("docs/formats/nodes.md").split("\n## What else is read")[0] ?? "";
  for (const section of text.split("\n### ").slice(1)) {
    const [heading = "", ...lines] = section.split("\n");
    const begin = lines.indexOf("| field | type | default | meaning |");
    if (begin < 0) continue;
    const rows = lines.slice(begin + 2, lines.indexOf("", begin)).map((line) => line.split(" | "));
    const table = new Map(
      rows.map(([name = "", type = "", defaultText = ""]) => [name.replace(/[|`\s]/g, ""), { type, defaultText }]),
    );
    const list = lines.find((line) => line.startsWith("Nodes: "));
    const nodes = list === undefined ? [heading] : [...list.matchAll(/`(\w+)`/g)].map(([, name = ""]) => name);
    assert.equal(table.size, rows.length, `${heading} names a field twice`);
    sections.set(heading, { nodes, table });
  }
  return sections;
}

const documented = documentedSections();

/** The documented fields of a node, those of the sections that several nodes share included. */
function documentedFields(node: string): Map<string, Row> {
  const shared = [...documented.values()].filter(({ nodes }) => nodes.includes(node));
  return new Map(shared.flatMap(({ table }) => [...table]));
}

/** The fields of nodes that send events, without fields that only take or send them. */
function eventNodeFields(): Record<string, Record<string, Field<unknown>>> {
  return Object.fromEntries(
    Object.entries(nodeTypes).map(([node, { fields }]) => [
      node,
      Object.fromEntries(
        [...fields]
          .filter(([, { access }]) => access === "inputOutput" || access === "initializeOnly")
          .map(([name, { type, defaultValue }]) => [name, { type, defaultValue }]),
      ),
    ]),
  );
}

const runtime: Readonly<Record<string, Readonly<Record<string, Field<unknown>>>>> = {
  ...nodeFields,
  ...eventNodeFields(),
};

/** Headings of nodes that convert makes meshes of, and that pages do not read. */
const convertedNodes = ["NURBS curves and surfaces"];

/** Rows of the runtime's table that hold the fields of several nodes; their nodes are in the documented list. */
const sharedRows: Readonly<Record<string, string>> = { InlineGeometry: "Geometry of polygons, lines and points" };

/** Fields that the converter writes or reads but nodes.ts lacks, by the reason. */
const notInRuntimeTable: Readonly<Record<string, readonly string[]>> = {
  "written by src/documents and not read": ["X3D.profile", "X3D.version", "TextureProperties.generateMipMaps"],
  "used in the page's title, or read by the converter": [
    "WorldInfo.title",
    "WorldInfo.info",
    "MetadataString.name",
    "MetadataString.value",
  ],
  "read by web/src/animation/documents.ts": [
    ...["fromNode", "fromField", "toNode", "toField"].map((field) => `ROUTE.${field}`),
    ...["IMPORT.inlineDEF", "IMPORT.importedDEF", "IMPORT.AS", "EXPORT.localDEF", "EXPORT.AS"],
  ],
  "read as an attribute by web/src/document/appearance.ts": ["PixelTexture.containerField", "TextureTransform.mapping"],
};

/** Fields of the runtime's table that node_fields.h lacks although it has the node, by the reason. */
const notInConverterTable: Readonly<Record<string, readonly string[]>> = {
  "kept as further attributes of the element (Node::fields in src/scene/scene.h)": [
    ...["priority", "bboxCenter", "bboxSize", "visible", "render"].map((name) => `Transform.${name}`),
    ...["Viewpoint", "OrthoViewpoint"].flatMap((node) => [`${node}.bind`, `${node}.set_bind`]),
  ],
  "X3D sources keep their materials as generic nodes, with all fields; no other source has a Material with these": [
    "Material.normalScale",
    "Material.occlusionStrength",
  ],
  "two members of a struct, which content_element.cpp handles": ["OrthoViewpoint.fieldOfView"],
  "read by content_element.cpp, which leaves out lights that are off": [
    "DirectionalLight.on",
    "PointLight.on",
    "SpotLight.on",
  ],
};

const knownOnlyToTheConverter = new Set(Object.values(notInRuntimeTable).flat());

/** Whether a documented X3D type is the one that the runtime reads with the type named `runtimeType`. */
function isTypeOf(documentedType: string, runtimeType: string): boolean {
  if (runtimeType.startsWith("priority")) return documentedType === "SFFloat";
  if (runtimeType.startsWith("color map")) return documentedType === "SFString";
  if (runtimeType === "SFString" && documentedType === "URL") return true;
  // The runtime reads lists of vectors as one list of numbers.
  if (runtimeType === "MFFloat") return /^MF(Float|Vec2f|Vec3f|Color|Rotation)$/.test(documentedType);
  return documentedType === runtimeType;
}

function valueOf(field: Field<unknown>, defaultText: string): unknown {
  if (defaultText === "–") return undefined;
  return field.type.parse(["[]", '""'].includes(defaultText) ? "" : defaultText);
}

function assertSameField(name: string, field: Field<unknown>, { type, defaultText }: Row): void {
  assert.ok(isTypeOf(type, field.type.name), `${name}: ${type} is documented, the runtime reads ${field.type.name}`);
  assert.deepEqual(valueOf(field, defaultText), field.defaultValue, `the default of ${name}`);
}

test("every field of the runtime is documented with its type and default", () => {
  for (const [node, fields] of Object.entries(runtime)) {
    const rows = documented.get(sharedRows[node] ?? "")?.table ?? documentedFields(node);
    for (const [name, field] of Object.entries(fields)) {
      const row = rows.get(name);
      assert.ok(row, `docs/formats/nodes.md does not have ${node}.${name}`);
      assertSameField(`${node}.${name}`, field, row);
    }
  }
});

test("every documented field is read by the runtime, or listed here with the reason why not", () => {
  const missing: string[] = [];
  for (const [heading, { nodes, table }] of documented) {
    if (convertedNodes.includes(heading)) continue;
    const shared = Object.keys(sharedRows).find((row) => sharedRows[row] === heading);
    for (const node of shared === undefined ? nodes : [shared]) {
      const readAsGroup = ["StaticGroup", "Collision", "HAnimSegment"];
      const fields = runtime[node] ?? (readAsGroup.includes(node) ? runtime.Group : undefined);
      for (const name of table.keys()) if (!fields?.[name]) missing.push(`${node}.${name}`);
    }
  }
  assert.deepEqual(missing.toSorted(), [...knownOnlyToTheConverter].toSorted());
});

test("the converter's table has every field of its nodes, but for those that are listed here with the reason", () => {
  const converter = JSON.parse(read("vectors/nodes.json")) as Record<string, Record<string, unknown>>;
  const missing = Object.entries(converter).flatMap(([node, fields]) =>
    Object.keys(runtime[node] ?? {})
      .filter((name) => !(name in fields))
      .map((name) => `${node}.${name}`),
  );
  assert.deepEqual(missing.toSorted(), Object.values(notInConverterTable).flat().toSorted());
});

test("the converter and the runtime give every field that both know the same type and default", () => {
  const converter = JSON.parse(read("vectors/nodes.json")) as Record<string, Record<string, [string, string]>>;
  assert.ok(Object.keys(converter).length >= 10);
  for (const [node, fields] of Object.entries(converter))
    for (const [name, [type, defaultText]] of Object.entries(fields)) {
      const fullName = `${node}.${name}`;
      const documentedRow = documentedFields(node).get(name);
      assert.ok(documentedRow, `docs/formats/nodes.md does not have ${fullName}`);
      assert.equal(type, documentedRow.type, fullName);
      if (knownOnlyToTheConverter.has(fullName)) continue;
      const field = runtime[node]?.[name];
      assert.ok(field, `web/src/document/nodes.ts does not have ${fullName}`);
      assertSameField(fullName, field, { type, defaultText: defaultText === "" ? '""' : defaultText });
    }
});

/** Types of the fields that a method of the converter's readers returns (field_reader.h, import/x3d/source.h). */
const typesOfMethod: Readonly<Record<string, RegExp>> = {
  text: /^(SFString|URL)$/,
  boolean: /^SFBool$/,
  real: /^(SFFloat|SFInt32)$/,
  integer: /^SFInt32$/,
  integers: /^MFInt32$/,
  vec2: /^SFVec2f$/,
  vec3: /^(SFVec3f|SFColor)$/,
  reals: /^(MF\w+|SFVec2f)$/,
  strings: /^MFString$/,
};

/** Nodes that convert reads and never writes: docs/formats/x3dom-geometry.md has their fields. */
const onlyRead = ["PopGeometry", "PopGeometryLevel", "ExternalGeometry", "ExternalShape"];

/**
 * Attributes that every node has or that are HTML's, and fields that the converter refuses unless they have their
 * default.
 */
const notDocumented = ["DEF", "USE", "compressed", "src"];

/** Calls such as `fields.real("alphaCutoff", 0.5f)` or `boolean(node_, "ccw", true)`: method, field, default. */
function fieldsReadBy(folder: string): { where: string; method: string; name: string; fallback: string }[] {
  const call = /\b(\w+)\((?:node_?, |element, )?"([A-Za-z]+)"(?:, ([^()]*?))?\)/g;
  return readdirSync(join(root, folder))
    .filter((file) => file.endsWith(".cpp") && !file.endsWith("_test.cpp") && file !== "pop_geometry.cpp")
    .flatMap((file) =>
      [...read(`${folder}/${file}`).matchAll(call)]
        .map(([, method = "", name = "", fallback = ""]) => ({ where: `${folder}/${file}`, method, name, fallback }))
        .filter(({ method, name }) => method in typesOfMethod && !notDocumented.includes(name)),
    );
}

test("every field that the converter reads by its name is documented, with that type and default", () => {
  const rowsByName = new Map<string, Row[]>();
  for (const { table } of documented.values())
    for (const [name, row] of table) rowsByName.set(name, [...(rowsByName.get(name) ?? []), row]);
  const reads = ["src/documents", "src/import/x3d"].flatMap(fieldsReadBy);
  assert.ok(reads.length > 40, "the calls that read fields were not found");
  for (const { where, method, name, fallback } of reads) {
    const rows = rowsByName.get(name) ?? [];
    const typed = rows.filter(({ type }) => typesOfMethod[method]?.test(type));
    assert.ok(typed.length > 0, `${where} reads ${name} with ${method}(): docs/formats/nodes.md has no such field`);
    if (method === "reals" || !/^(true|false|[\d.]+f?)$/.test(fallback)) continue;
    const text = /^\d/.test(fallback) ? fallback.replace(/f$/, "") : fallback;
    assert.ok(
      typed.some(({ defaultText }) => defaultText === text),
      `${where}: the default of ${name} is ${text}, not what docs/formats/nodes.md says`,
    );
  }
});

/** The strings of the list in a C++ source that begins with `beginning`. */
function stringsOf(path: string, beginning: string): string[] {
  const text = read(path);
  const begin = text.indexOf(beginning);
  assert.ok(begin >= 0, `${path} has no ${beginning}`);
  return [...text.slice(begin, text.indexOf("}", begin)).matchAll(/"(\w+)"/g)].map(([, name = ""]) => name);
}

/** The converter's table of nodes, without statements. */
function treatments(): { name: string; containerField: string; treatment: string }[] {
  const row = /^ {4}\{"(\w+)", "(?!statement)[\w ]+", \d, "(\w+)", (\w+),/gm;
  return [...read("src/import/x3d/node_table.cpp").matchAll(row)].map(
    ([, name = "", containerField = "", treatment = ""]) => ({ name, containerField, treatment }),
  );
}

test("the converter's list of geometry nodes that pages draw equals the documented one", () => {
  const [, documentGeometry = ""] = read("docs/formats/nodes.md").split("\n## Geometry in the document\n");
  const notGeometry = [
    ...["Coordinate", "Normal", "TextureCoordinate", "TextureCoordinateGenerator", "Color", "FogCoordinate"],
    "FontStyle",
  ];
  const inDocument = [...documented].filter(([heading]) =>
    documentGeometry.split("\n## ")[0]?.includes(`### ${heading}\n`),
  );
  const expected = inDocument.flatMap(([, { nodes }]) => nodes).filter((node) => !notGeometry.includes(node));
  // Pages draw NURBS as the meshes that convert makes of them.
  const drawn = treatments().filter(
    ({ name, containerField, treatment }) =>
      containerField === "geometry" && treatment === "drawn" && !name.startsWith("Nurbs") && !onlyRead.includes(name),
  );
  assert.deepEqual(
    drawn.map(({ name }) => name).toSorted(),
    [...expected, "ImageGeometry", "BinaryGeometry"].toSorted(),
  );
});

test("pages may contain every node of X3D that convert writes", () => {
  const allowed = stringsOf("src/documents/page_sanitizer.cpp", "allowedElements[]");
  const written = treatments().filter(({ treatment }) => ["drawn", "kept"].includes(treatment));
  assert.ok(written.length > 100, "the rows of the table were not found");
  const ours = ["X3D", "ImageGeometry", "BinaryGeometry", "GeometryPatch", ...onlyRead];
  const documentedNodes = [...documented.values()].flatMap((section) => section.nodes);
  const nodes = [...documentedNodes, ...written.map(({ name }) => name)].filter((node) => !ours.includes(node));
  assert.deepEqual(
    nodes.filter((node) => !allowed.includes(node)),
    [],
  );
});

/** The fields of X3D's nodes, without nodes as values, as X_ITE defines them: its sources are in the npm package. */
function fieldsOfX3d(): Map<string, string[]> {
  const folder = "node_modules/x_ite/dist/assets/components";
  const components = readdirSync(join(root, folder)).filter((name) => name.endsWith("Component.js"));
  const texts = ["node_modules/x_ite/dist/x_ite.mjs", ...components.map((name) => `${folder}/${name}`)].map(read);
  const fields = new Map<string, string[]>();
  const definition =
    /Object \.defineProperties \((?:\w+_)?(\w+),|FieldDefinition[\w. ()]*\.(?:inputOutput|initializeOnly), *"(\w+)", *new [\w. ()]*\.(\w+) /g;
  let node: string[] = [];
  for (const [, name, field = "", type = ""] of texts.join("\n").matchAll(definition))
    if (name !== undefined) fields.set(name, (node = fields.get(name) ?? []));
    else if (!type.endsWith("Node")) node.push(field);
  return fields;
}

/** Fields of every node of some kind that change no picture, and fields that X_ITE adds to X3D 4.0. */
const fieldsOfNoPicture = [
  ...["visible", "bboxCenter", "bboxSize", "bboxDisplay", "load", "autoRefresh", "autoRefreshTimeLimit"],
  ...["shadowColor", "shadowBias", "shadowMapSize", "visibilityStart"],
];

/** Fields that are read although docs/formats/nodes.md does not list them for the node; the keys say where. */
const readElsewhere: Readonly<Record<string, readonly string[]>> = {
  "in the text of nodes.md": [
    ...["solid", "ccw", "convex", "creaseAngle"].map((field) => `ElevationGrid.${field}`),
    ...["solid", "ccw", "convex", "creaseAngle"].map((field) => `Extrusion.${field}`),
    ...["Box", "Cone", "Cylinder", "Sphere"].map((node) => `${node}.solid`),
    ...["ColorRGBA.color", "CoordinateDouble.point", "TextureCoordinateGenerator.mapping"],
  ],
  "by src/import/x3d/geometry.cpp, and kept as fields of the Shape's mesh": [
    ...["NurbsPatchSurface", "NurbsTrimmedSurface"].map((node) => `${node}.solid`),
    ...["NurbsSweptSurface", "NurbsSwungSurface"].flatMap((node) => [`${node}.solid`, `${node}.ccw`]),
  ],
  "by src/import/x3d/node_conversions.cpp": ["LayerSet.activeLayer", "LayerSet.order"],
};

test("every field of the nodes that are drawn or converted is documented, or listed as without effect", () => {
  const listed = new Set(
    [...read("docs/formats/x3d-nodes.md").matchAll(/^\| `(\w+)` \| `(\w+)` \| /gm)].map(
      ([, node = "", field = ""]) => `${node}.${field}`,
    ),
  );
  assert.ok(listed.size > 40, "the table of fields without effect was not found");
  const known = new Set([...listed, ...Object.values(readElsewhere).flat()]);
  const ofMaterial = (field: string) => field.endsWith("TextureMapping");
  const definitions = fieldsOfX3d();
  // Nodes of CAD, HAnim and simulation become groups, and their line in the summary says so: their other fields
  // describe parts, skins and bodies.
  const drawn = treatments().filter(
    ({ name, treatment }) =>
      treatment === "drawn" || (treatment === "converted" && !/^(CAD|HAnim|Collidable|Espdu)/.test(name)),
  );
  const found = drawn.filter(({ name }) => definitions.has(name));
  assert.ok(found.length > 80, "the definitions of X_ITE were not found");
  // A node that is written as another has the fields of that one.
  const writtenAs = (name: string) => (name === "TwoSidedMaterial" ? "Material" : name);
  const missing = found.flatMap(({ name }) =>
    (definitions.get(name) ?? [])
      .filter((field) => !fieldsOfNoPicture.includes(field) && !ofMaterial(field))
      .filter((field) => !documentedFields(name).has(field) && !documentedFields(writtenAs(name)).has(field))
      .map((field) => `${name}.${field}`)
      .filter((field) => !known.has(field)),
  );
  assert.deepEqual(missing, []);
});
