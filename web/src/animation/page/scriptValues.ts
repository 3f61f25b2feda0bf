// Values of fields as scripts see them: vectors, colours and rotations have X3DOM's members and can be written into an
// attribute as they are.

import type { FieldType, Value } from "../fieldTypes.ts";

const members: Readonly<Record<string, readonly string[]>> = {
  SFVec2f: ["x", "y"],
  SFVec3f: ["x", "y", "z"],
  SFVec3d: ["x", "y", "z"],
  SFVec4f: ["x", "y", "z", "w"],
  SFColor: ["r", "g", "b"],
  SFColorRGBA: ["r", "g", "b", "a"],
  SFRotation: ["x", "y", "z", "angle"],
};

/** Lists are copies. */
export function scriptValueOf(type: FieldType, value: Value): unknown {
  const names = members[type.name];
  if (names === undefined) return Array.isArray(value) ? Array.from(value as readonly unknown[]) : value;
  const numbers = value as readonly number[];
  const text = type.format(value);
  const entries: [string, unknown][] = names.map((name, i) => [name, numbers[i]]);
  return Object.freeze({ ...Object.fromEntries(entries), toString: () => text });
}

/** The value that a script means: its own form, a list of numbers, or text as in an attribute. Undefined: none. */
export function valueFromScript(type: FieldType, value: unknown): Value | undefined {
  if (typeof value === "string" && type.name !== "SFString") return type.parse(value);
  const names = members[type.name];
  if (names && typeof value === "object" && value !== null && !Array.isArray(value))
    return names.map((name) => Number((value as Readonly<Record<string, unknown>>)[name]));
  if (ArrayBuffer.isView(value) && !(value instanceof DataView)) return Array.from(value as Float32Array);
  return value as Value;
}
