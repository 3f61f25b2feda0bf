// Parsers of X3D's field types in XML encoding (ISO/IEC 19776-1), where white space or commas separate values. A parser
// returns undefined for text that is not of its type.

import type { Vec3 } from "../tessellate/vectors.ts";
import type { PixelImage } from "./pixelImage.ts";
import { pixelImageOf } from "./pixelImage.ts";
import { entryOf } from "./tables.ts";

export type { Vec3 };
export type Vec2 = readonly [number, number];
/** Axis and angle in radians. */
export type Vec4 = readonly [number, number, number, number];
export type Rotation = readonly [number, number, number, number];

export interface FieldType<Value> {
  readonly name: string;
  parse(text: string): Value | undefined;
}

/** A field of a node: its type and default value. */
export interface Field<Value> {
  readonly type: FieldType<Value>;
  readonly defaultValue: Value;
}

const separators = /[\s,]+/;

function numbersIn(text: string): number[] | undefined {
  const words = text.split(separators).filter((word) => word !== "");
  const numbers = words.map(Number);
  return numbers.every(Number.isFinite) ? numbers : undefined;
}

function tuple<Value>(name: string, length: number): FieldType<Value> {
  return {
    name,
    parse(text) {
      const numbers = numbersIn(text);
      return numbers?.length === length ? (numbers as Value) : undefined;
    },
  };
}

const sfBool: FieldType<boolean> = {
  name: "SFBool",
  parse(text) {
    const word = text.trim().toLowerCase();
    return word === "true" ? true : word === "false" ? false : undefined;
  },
};

const sfFloat: FieldType<number> = {
  name: "SFFloat",
  parse(text) {
    const numbers = numbersIn(text);
    return numbers?.length === 1 ? numbers[0] : undefined;
  },
};

const mfFloat: FieldType<readonly number[]> = { name: "MFFloat", parse: numbersIn };

const sfInt32: FieldType<number> = {
  name: "SFInt32",
  parse(text) {
    const value = sfFloat.parse(text);
    return value !== undefined && isInteger(value) ? value : undefined;
  },
};

/** Whether a number has at most 32 bits, signed or not. */
function isInteger(value: number): boolean {
  return Number.isInteger(value) && value >= -(2 ** 31) && value < 2 ** 32;
}

const mfInt32: FieldType<readonly number[]> = {
  name: "MFInt32",
  parse(text) {
    const numbers = numbersIn(text);
    return numbers?.every(isInteger) === true ? numbers : undefined;
  },
};

/** A relative priority: a number of 0 or more, or a keyword of HTML's `fetchpriority`. */
const priority: FieldType<number> = {
  name: "priority (a number of 0 or more, high, auto or low)",
  parse(text) {
    const word = entryOf(priorityWords, text.trim().toLowerCase());
    if (word !== undefined) return word;
    const value = sfFloat.parse(text);
    return value !== undefined && value >= 0 ? value : undefined;
  },
};

const priorityWords: Readonly<Record<string, number>> = { high: 4, auto: 1, low: 1 / 4 };

const sfString: FieldType<string> = { name: "SFString", parse: (text) => text };

/** Quoted strings ("a" "b"); in text without quotes every word is a string. */
const mfString: FieldType<readonly string[]> = {
  name: "MFString",
  parse(text) {
    if (!text.includes('"')) return text.split(separators).filter((word) => word !== "");
    const strings: string[] = [];
    const rest = text.replace(/"((?:[^"\\]|\\.)*)"/g, (_, quoted: string) => {
      strings.push(quoted.replace(/\\(.)/g, "$1"));
      return "";
    });
    return rest.replace(separators, "") === "" ? strings : undefined;
  },
};

/** Like MFString, but text without quotes is one URL, as in X3DOM: it may have spaces. */
const mfUrl: FieldType<readonly string[]> = {
  name: "MFString",
  parse: (text) => (text.includes('"') ? mfString.parse(text) : text.trim() === "" ? [] : [text.trim()]),
};

/** Like MFString, but text without quotes is one string. */
const mfText: FieldType<readonly string[]> = {
  name: "MFString",
  parse: (text) => (text.includes('"') ? mfString.parse(text) : text === "" ? [] : [text]),
};

const sfImage: FieldType<PixelImage> = {
  name: "SFImage",
  parse(text) {
    const numbers = numbersIn(text);
    return numbers && pixelImageOf(numbers);
  },
};

const mfColor: FieldType<readonly Vec3[]> = {
  name: "MFColor",
  parse(text) {
    const numbers = numbersIn(text);
    if (numbers === undefined || numbers.length % 3 !== 0) return undefined;
    return Array.from({ length: numbers.length / 3 }, (_, i) => numbers.slice(3 * i, 3 * i + 3) as unknown as Vec3);
  },
};

function fieldMaker<Value>(type: FieldType<Value>): (defaultValue: Value) => Field<Value> {
  return (defaultValue) => ({ type, defaultValue });
}

/** The same field with undefined as its default. */
export function optional<Value>(field: Field<Value>): Field<Value | undefined> {
  return { ...field, defaultValue: undefined };
}

export const SFBool = fieldMaker(sfBool);
export const SFFloat = fieldMaker(sfFloat);
export const SFInt32 = fieldMaker(sfInt32);
export const Priority = fieldMaker(priority);
export const SFString = fieldMaker(sfString);
export const SFVec2f = fieldMaker(tuple<Vec2>("SFVec2f", 2));
export const SFVec3f = fieldMaker(tuple<Vec3>("SFVec3f", 3));
export const SFVec4f = fieldMaker(tuple<Vec4>("SFVec4f", 4));
export const SFColor = fieldMaker(tuple<Vec3>("SFColor", 3));
export const SFImage = fieldMaker(sfImage);
export const SFRotation = fieldMaker(tuple<Rotation>("SFRotation", 4));
export const MFInt32 = fieldMaker(mfInt32);
export const MFFloat = fieldMaker(mfFloat);
/** 16 numbers for each matrix. */
export const MFMatrix4f = fieldMaker<readonly number[]>({ name: "MFMatrix4f", parse: numbersIn });
export const MFString = fieldMaker(mfString);
export const MFUrl = fieldMaker(mfUrl);
export const MFText = fieldMaker(mfText);
export const MFColor = fieldMaker(mfColor);
