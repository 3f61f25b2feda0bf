// What of X3DOM's nodes for geometry is not shown, each with the sentence that the author reads. docs/formats/
// x3dom-geometry.md has the whole table, and tests/x3domGeometry.test.ts compares both.

import type { SceneElement } from "./element.ts";
import { attributeOf, lowerNameOf } from "./element.ts";
import type { Field } from "./fieldTypes.ts";
import { SFBool, SFFloat, SFInt32, SFString } from "./fieldTypes.ts";
import type { Warning } from "./nodes.ts";
import { entryOf } from "./tables.ts";

const readByConvert = "pages do not draw it; imgeo convert reads the document and writes patches of it";

/** Nodes that are left out, by their lower-case name. */
const refusedNodes: Readonly<Record<string, string>> = {
  popgeometry: readByConvert,
  popgeometrylevel: "a PopGeometryLevel is part of a PopGeometry, which pages do not draw",
  externalgeometry: readByConvert,
  externalshape: readByConvert,
  bitlodgeometry: "pages do not draw it; X3DOM itself has given it up for PopGeometry",
  buffergeometry: "pages do not draw it; imgeo convert reads the glTF file that its buffer belongs to",
  bvhrefiner: "pages do not draw it; imgeo convert makes patches and levels of detail of the whole model",
  multipart: "pages do not draw it; an Inline shows the same document, without the parts' own materials",
  dynamiclod: "pages do not draw it; an LOD of Inlines shows terrain by the viewer's distance",
  nurbs: "NURBS are not drawn in pages; imgeo convert makes triangles of them",
};

/** Tells authors what is not shown. */
export interface Refusals {
  /** Why a node is left out; undefined for others. */
  readonly reasonAgainst: (element: SceneElement) => string | undefined;
  /** Warns of fields whose value the author set in vain. */
  readonly warnOfFields: (element: SceneElement, warnings: Warning[]) => void;
}

export const refusals: Refusals = { reasonAgainst, warnOfFields };

function reasonAgainst(element: SceneElement): string | undefined {
  const name = lowerNameOf(element);
  return entryOf(refusedNodes, name.startsWith("nurbs") ? "nurbs" : name);
}

interface RefusedField {
  readonly field: Field<unknown>;
  readonly reason: string;
}

const notRead = (field: Field<unknown>, reason: string): RefusedField => ({ field, reason });

/** Fields that have no effect, by their node's lower-case name: a value other than the default is reported. */
const refusedFields: Readonly<Record<string, Readonly<Record<string, RefusedField>>>> = {
  imagegeometry: {
    numTexCoordComponents: notRead(SFInt32(2), "texture coordinates have two components"),
  },
  binarygeometry: {
    numTexCoordComponents: notRead(SFInt32(2), "texture coordinates have two components"),
    idsPerVertex: notRead(SFBool(false), "the parts of a MultiPart are not read; texCoord is not a texture coordinate"),
    tangent: notRead(SFString(""), "normal maps follow the texture coordinates"),
    tangentType: notRead(SFString("Float32"), "tangents are not read"),
    binormal: notRead(SFString(""), "normal maps follow the texture coordinates"),
    binormalType: notRead(SFString("Float32"), "binormals are not read"),
  },
  clipplane: {
    cappingStrength: notRead(SFFloat(0), "cut surfaces are not closed"),
    on: notRead(SFBool(true), "enabled turns the plane off"),
  },
};

function warnOfFields(element: SceneElement, warnings: Warning[]): void {
  for (const [name, { field, reason }] of Object.entries(entryOf(refusedFields, lowerNameOf(element)) ?? {})) {
    const text = attributeOf(element, name);
    if (text === undefined || isSame(field.type.parse(text), field.defaultValue)) continue;
    warnings.push({ element, message: `${name}="${text}" has no effect: ${reason}` });
  }
}

function isSame(value: unknown, defaultValue: unknown): boolean {
  return JSON.stringify(value) === JSON.stringify(defaultValue);
}
