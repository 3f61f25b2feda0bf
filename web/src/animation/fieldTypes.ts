// The field types of X3D whose values events carry: how attributes spell them (ISO/IEC 19776-1), and when an event may
// go from one field to another. Lists of vectors are flat lists of numbers.

export type Value = number | boolean | string | readonly number[] | readonly boolean[] | readonly string[];

export interface FieldType {
  readonly name: string;
  /** The numbers of one element, for types of numbers; 0 for the others. */
  readonly size: number;
  readonly isList: boolean;
  /** Undefined for text that is not of this type: NaN and infinite numbers, too. */
  parse(text: string): Value | undefined;
  format(value: Value): string;
}

const separators = /[\s,]+/;

function numbersIn(text: string): number[] | undefined {
  const numbers: number[] = [];
  for (const word of text.split(separators)) {
    if (word === "") continue;
    const number = Number(word);
    if (!Number.isFinite(number)) return undefined;
    numbers.push(number);
  }
  return numbers;
}

function booleanIn(word: string): boolean | undefined {
  const lower = word.toLowerCase();
  return lower === "true" ? true : lower === "false" ? false : undefined;
}

function formatList(value: Value): string {
  return (value as readonly unknown[]).join(" ");
}

function single(name: string, isWhole = false): FieldType {
  return {
    name,
    size: 1,
    isList: false,
    parse(text) {
      const numbers = numbersIn(text);
      const [number] = numbers ?? [];
      return numbers?.length === 1 && number !== undefined && (!isWhole || Number.isInteger(number))
        ? number
        : undefined;
    },
    format: String,
  };
}

function tuple(name: string, size: number): FieldType {
  return {
    name,
    size,
    isList: false,
    parse(text) {
      const numbers = numbersIn(text);
      return numbers?.length === size ? numbers : undefined;
    },
    format: formatList,
  };
}

function list(name: string, size: number, isWhole = false): FieldType {
  return {
    name,
    size,
    isList: true,
    parse(text) {
      const numbers = numbersIn(text);
      return numbers && numbers.length % size === 0 && (!isWhole || numbers.every(Number.isInteger))
        ? numbers
        : undefined;
    },
    format: formatList,
  };
}

const types: readonly FieldType[] = [
  {
    name: "SFBool",
    size: 0,
    isList: false,
    parse: (text) => booleanIn(text.trim()),
    format: String,
  },
  {
    name: "MFBool",
    size: 0,
    isList: true,
    parse(text) {
      const words = text.split(separators).filter((word) => word !== "");
      const values = words.map(booleanIn).filter((value) => value !== undefined);
      return values.length === words.length ? values : undefined;
    },
    format: formatList,
  },
  { name: "SFString", size: 0, isList: false, parse: (text) => text, format: String },
  // As its attribute has it: no event changes one of its strings.
  { name: "MFString", size: 0, isList: false, parse: (text) => text, format: String },
  ...["SFFloat", "SFDouble", "SFTime"].map((name) => single(name)),
  single("SFInt32", true),
  ...["MFFloat", "MFDouble", "MFTime"].map((name) => list(name, 1)),
  list("MFInt32", 1, true),
  ...["SFVec2f", "SFVec2d"].map((name) => tuple(name, 2)),
  ...["SFVec3f", "SFVec3d", "SFColor"].map((name) => tuple(name, 3)),
  ...["SFVec4f", "SFVec4d", "SFColorRGBA", "SFRotation"].map((name) => tuple(name, 4)),
  ...["MFVec2f", "MFVec2d"].map((name) => list(name, 2)),
  ...["MFVec3f", "MFVec3d", "MFColor"].map((name) => list(name, 3)),
  ...["MFVec4f", "MFVec4d", "MFColorRGBA", "MFRotation"].map((name) => list(name, 4)),
];

const byName = new Map(types.map((type) => [type.name, type]));

/** Undefined for types whose values no event carries: nodes and images. */
export function fieldTypeOf(name: string): FieldType | undefined {
  return byName.get(name);
}

/** The type with this name, which must be one of the table. */
export function fieldType(name: string): FieldType {
  const type = byName.get(name);
  if (type === undefined) throw new Error(`there is no field type ${name}`);
  return type;
}

/**
 * Whether an event may go from a field of one type to a field of the other. The types must be equal (ISO/IEC 19775-1,
 * 4.4.8.2); the runtime's own tables call every list of numbers MFFloat.
 */
export function mayRoute(from: FieldType, to: FieldType): boolean {
  return from === to || (to.name === "MFFloat" && from.isList && from.size > 0 && from.name !== "MFInt32");
}

/** Whether a value that comes from a script is of the type. */
export function isOfType(value: unknown, type: FieldType): value is Value {
  if (type.isList) return Array.isArray(value) && value.length % Math.max(1, type.size) === 0 && isOfItems(value, type);
  if (type.size > 1) return Array.isArray(value) && value.length === type.size && isOfItems(value, type);
  if (type.size === 1) return Number.isFinite(value);
  return typeof value === (type.name === "SFBool" ? "boolean" : "string");
}

function isOfItems(values: readonly unknown[], type: FieldType): boolean {
  return values.every((item) => (type.size > 0 ? Number.isFinite(item) : typeof item === "boolean"));
}
