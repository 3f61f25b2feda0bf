// Reads lists of operators, as the field `operators` has them.

import type { Vec3 } from "./fieldTypes.ts";
import type { Box3 } from "./geometryDescription.ts";
import type { Operator } from "./operators.ts";
import { blurRadiusOf, maxBlurRadius, maxOperators, operatedBox } from "./operators.ts";

type Arguments = readonly number[];
type Make = (numbers: Arguments, axes: string) => Operator | string;

const none: Vec3 = [0, 0, 0];

/** One number for all axes, or one for each; undefined for another count. */
function vectorOf(numbers: Arguments): Vec3 | undefined {
  const [x, y, z] = numbers;
  if (x === undefined) return undefined;
  if (numbers.length === 1) return [x, x, x];
  return numbers.length === 3 && y !== undefined && z !== undefined ? [x, y, z] : undefined;
}

function withVector(make: (vector: Vec3) => Operator | string): Make {
  return (numbers, axes) => {
    const vector = axes === "" ? vectorOf(numbers) : undefined;
    return vector === undefined ? "takes one number, or one for each axis" : make(vector);
  };
}

const add = withVector((b) => ({ kind: "affine", a: [1, 1, 1], b }));
/** Around the middle of the box. */
const stretch = withVector((a) => ({
  kind: "affine",
  a,
  b: [(1 - a[0]) / 2, (1 - a[1]) / 2, (1 - a[2]) / 2],
}));
const negate: Make = (numbers, axes) => {
  if (numbers.length > 0 || !/^(?!.*(.).*\1)[xyz]*$/.test(axes)) return "takes axes, such as xz, or nothing";
  const isNegated = (axis: string) => axes === "" || axes.includes(axis);
  const of = (yes: number, no: number): Vec3 => [
    isNegated("x") ? yes : no,
    isNegated("y") ? yes : no,
    isNegated("z") ? yes : no,
  ];
  return { kind: "affine", a: of(-1, 1), b: of(1, 0) };
};
const posterise: Make = ([levels = NaN, ...others], axes) => {
  const isValid = axes === "" && others.length === 0 && Number.isInteger(levels) && levels >= 2 && levels <= 65536;
  return isValid
    ? { kind: "steps", a: [levels - 1, levels - 1, levels - 1], b: none }
    : "takes a number of levels, 2 to 65536";
};

const blur: Make = ([radius = NaN, ...others], axes) =>
  axes === "" && others.length === 0 && radius >= 0 && radius <= maxBlurRadius
    ? { kind: "blur", a: [radius, 0, 0], b: none }
    : `takes a radius of 0 to ${maxBlurRadius} texels`;

const makers: ReadonlyMap<string, Make> = new Map<string, Make>([
  ["translate", add],
  ["brightness", add],
  ["scale", stretch],
  ["contrast", stretch],
  [
    "gamma",
    withVector((a) => (a.every((exponent) => exponent > 0) ? { kind: "power", a, b: none } : "takes positive numbers")),
  ],
  ["negate", negate],
  ["negative", negate],
  [
    "swizzle",
    (numbers, axes) =>
      numbers.length === 0 && /^(?!.*(.).*\1)[xyz]{3}$/.test(axes)
        ? { kind: "permute", a: Array.from(axes, (axis) => "xyz".indexOf(axis)) as unknown as Vec3, b: none }
        : "takes the three axes in some order, such as yxz",
  ],
  ["solarize", withVector((a) => ({ kind: "fold", a, b: none }))],
  [
    "threshold",
    ([first = NaN, second, ...others], axes) => {
      const [low, high] = second === undefined ? [-Infinity, first] : [first, second];
      if (axes !== "" || others.length > 0 || !(low <= high))
        return "takes the largest coordinate, or the smallest and the largest";
      const min = Math.max(low, -1e9);
      return { kind: "clamp", a: [min, min, min], b: [high, high, high] };
    },
  ],
  ["posterise", posterise],
  ["posterize", posterise],
  ["blur", blur],
]);

/** Not all that Number() reads: neither "0x10" nor "Infinity". */
const decimal = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
const largestNumber = 1e6;
/**
 * How far each operator of a list may map points: farther ones would not be finite in a shader, and a later operator
 * that multiplies them by zero would make them no numbers.
 */
const farthest = 1e9;

/** Whether no operator of a list maps points of the unit box farther than allowed. */
function stayInReach(operators: readonly Operator[]): boolean {
  let box: Box3 = { min: [0, 0, 0], max: [1, 1, 1] };
  return operators.every((operator) => {
    box = operatedBox([operator], box);
    return [...box.min, ...box.max].every((coordinate) => Math.abs(coordinate) <= farthest);
  });
}

/** A text as sentences quote it: not longer than a line. */
function quoted(text: string): string {
  const characters = Array.from(text);
  return `"${characters.length <= 60 ? text : characters.slice(0, 60).join("") + "…"}"`;
}

/**
 * Reads `operators`. One sentence for the first part that cannot be read; nothing is then applied. `hasImages`: whether
 * the geometry has images of coordinates, as SIG classic has them; a blur of other geometry is refused.
 */
export function readOperators(
  text: string,
  hasImages: boolean,
): { operators: readonly Operator[]; problem: string | undefined } {
  const refuse = (problem: string) => ({
    operators: [],
    problem: `operators=${quoted(text)}: ${problem}; none is applied`,
  });
  const operators: Operator[] = [];
  let rest = text.replace(/^[ \t\r\n,]+|[ \t\r\n,]+$/g, "");
  while (rest !== "") {
    const match = /^([a-z]+)[ \t\r\n]*\(([^()]*)\)[ \t\r\n,]*/i.exec(rest);
    if (match === null) return refuse(`${quoted(rest)} is no operator with arguments in parentheses`);
    const [whole, name = "", inside = ""] = match;
    rest = rest.slice(whole.length);
    const make = makers.get(name.toLowerCase());
    if (make === undefined) return refuse(`${quoted(name)} is none of ${Array.from(makers.keys()).join(", ")}`);
    const words = inside.split(/[ \t\r\n,]+/).filter((word) => word !== "");
    const axes = words.length === 1 && /^[a-z]+$/i.test(words[0] ?? "") ? (words[0] ?? "").toLowerCase() : "";
    const isNumber = (word: string) => decimal.test(word) && Math.abs(Number(word)) <= largestNumber;
    if (axes === "" && !words.every(isNumber))
      return refuse(`${quoted(inside)} of ${name} has something that is no number from -1000000 to 1000000`);
    const operator = make(axes === "" ? words.map(Number) : [], axes);
    if (typeof operator === "string") return refuse(`${name} ${operator}`);
    if (operators.length >= maxOperators) return refuse(`it has more than ${maxOperators} operators`);
    if (operator.kind === "blur" && operators.length > 0) return refuse("blur is not the first operator");
    operators.push(operator);
  }
  if (!stayInReach(operators)) return refuse("it maps points farther than 1e9 edges of their box");
  if (!hasImages && blurRadiusOf(operators) > 0)
    return refuse("blur filters images of coordinates, and this geometry has none");
  return { operators, problem: undefined };
}
