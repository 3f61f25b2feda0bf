// X3D's interpolators (ISO/IEC 19775-1, clause 19): functions of a fraction, defined by values at keys.

import { mixedColor } from "./colors.ts";
import type { Behaviour, EventNode, Field, FieldSpecification } from "./eventNode.ts";
import type { Value } from "./fieldTypes.ts";
import { isAscending, keySpanOf } from "./keys.ts";
import type { NodeType } from "./nodeType.ts";
import { initializeOnly, inputOnly, inputOutput, nodeType, outputOnly } from "./nodeType.ts";
import type { Quaternion, Rotation } from "./rotations.ts";
import { arcBetween, pointOf, quaternionOf, rotationOf, squad, squadControl, turnBetween } from "./rotations.ts";
import { splineValue, tangentsOf } from "./splines.ts";

/** The keys and values that an interpolator uses: pairs that are complete. */
interface Curve {
  readonly keys: readonly number[];
  /** Flat: `stride` numbers for each key. */
  readonly values: readonly number[];
  readonly stride: number;
}

/** The value between two keys. `weight`: 0 … 1. */
type Evaluation = (from: number, to: number, weight: number) => Value;

interface Interpolation {
  /** The numbers of one element of `keyValue`. */
  readonly size: number;
  /** Whether each key has as many elements as there are for it (coordinates, normals), or one. */
  readonly hasLists?: boolean;
  readonly evaluationOf: (curve: Curve, node: EventNode) => Evaluation;
  /** The output's name. */
  readonly output?: string;
  /** The field with the values. */
  readonly valueField?: string;
}

/** The curve of a node, with one warning where keys and values do not fit; undefined where there is none. */
function curveOf(node: EventNode, { size, hasLists, valueField = "keyValue" }: Interpolation): Curve | undefined {
  const keys = node.numbersOf("key");
  const values = node.numbersOf(valueField);
  const count = values.length / size;
  if (keys.length === 0 || count === 0) {
    if (keys.length > 0 || count > 0) node.warn(`has ${keys.length} keys and ${count} values, and sends no events`);
    return undefined;
  }
  if (!isAscending(keys)) {
    node.warn("has keys that are not in ascending order, and sends no events");
    return undefined;
  }
  if (hasLists) {
    const elements = Math.floor(count / keys.length);
    if (elements * keys.length !== count)
      node.warn(
        `has ${count} values, which are not a multiple of its ${keys.length} keys: the last ones have no effect`,
      );
    return elements === 0 ? undefined : { keys, values, stride: elements * size };
  }
  if (count === keys.length) return { keys, values, stride: size };
  node.warn(
    `has ${keys.length} keys and ${count} values: only the first ${Math.min(keys.length, count)} of both count`,
  );
  return { keys: keys.slice(0, count), values, stride: size };
}

class Interpolator implements Behaviour {
  readonly #node: EventNode;
  readonly #interpolation: Interpolation;
  readonly #output: Field | undefined;
  #curve: Curve | undefined;
  #evaluation: Evaluation | undefined;
  #isPrepared = false;

  constructor(node: EventNode, interpolation: Interpolation) {
    this.#node = node;
    this.#interpolation = interpolation;
    this.#output = node.fieldOf(interpolation.output ?? "value_changed");
  }

  receive(field: string, value: Value): void {
    if (field !== "set_fraction") {
      this.#isPrepared = false;
      return;
    }
    if (!this.#isPrepared) this.#prepare();
    if (this.#curve === undefined || this.#evaluation === undefined || this.#output === undefined) return;
    const { from, to, weight } = keySpanOf(this.#curve.keys, this.#curve.keys.length, value as number);
    this.#node.sendFrom(this.#output, this.#evaluation(from, to, weight));
  }

  /** Called before the first fraction, so that a scene of many interpolators is read at once and prepared when used. */
  #prepare(): void {
    this.#curve = curveOf(this.#node, this.#interpolation);
    this.#evaluation = this.#curve && this.#interpolation.evaluationOf(this.#curve, this.#node);
    this.#isPrepared = true;
  }
}

/**
 * Ours: a CoordinateInterpolator with a url has the frames of a sequence (docs/sequences.md) in place of keys. Pages
 * display the frame of each fraction that it receives; it sends the fraction and no coordinates.
 */
class CoordinateInterpolator implements Behaviour {
  readonly #node: EventNode;
  readonly #interpolator: Interpolator;

  constructor(node: EventNode, interpolation: Interpolation) {
    this.#node = node;
    this.#interpolator = new Interpolator(node, interpolation);
  }

  receive(field: string, value: Value): void {
    if (this.#node.valueOf("url") === "") this.#interpolator.receive(field, value);
    else if (field === "set_fraction") this.#node.send(sequenceFraction, Math.max(0, Math.min(1, value as number)));
  }
}

/** The event of a CoordinateInterpolator with a url, and of a MovieTexture. */
export const sequenceFraction = "fraction_changed";

/** Whether an event makes a sequence display another frame. */
export function isSequenceFraction(element: { readonly localName: string }, field: string): boolean {
  // The element's name is asked for last: the browser takes longer to give it than to send an event.
  return field === sequenceFraction && /^(coordinateinterpolator|movietexture)$/i.test(element.localName);
}

function linear({ values, stride }: Curve): Evaluation {
  if (stride === 3) return linearPoint(values);
  return (from, to, weight) => {
    const [a, b] = [from * stride, to * stride];
    const mixed = new Array<number>(stride);
    for (let c = 0; c < stride; c++) {
      const begin = values[a + c] ?? 0;
      mixed[c] = begin + ((values[b + c] ?? 0) - begin) * weight;
    }
    return mixed;
  };
}

/** Without a loop and an array that grows: a scene may move a thousand Transforms in every frame. */
function linearPoint(values: readonly number[]): Evaluation {
  return (from, to, weight) => {
    const mixed = (c: number): number => {
      const begin = values[3 * from + c] ?? 0;
      return begin + ((values[3 * to + c] ?? 0) - begin) * weight;
    };
    return [mixed(0), mixed(1), mixed(2)];
  };
}

function linearNumber({ values }: Curve): Evaluation {
  return (from, to, weight) => {
    const begin = values[from] ?? 0;
    return begin + ((values[to] ?? 0) - begin) * weight;
  };
}

function color({ values }: Curve): Evaluation {
  return (from, to, weight) =>
    mixedColor(values.slice(3 * from, 3 * from + 3), values.slice(3 * to, 3 * to + 3), weight);
}

/** Unit vectors, on the shorter great arc. */
function normals({ values, stride }: Curve): Evaluation {
  return (from, to, weight) => {
    const mixed = new Array<number>(stride);
    for (let c = 0; c < stride; c += 3) arc(values, from * stride + c, to * stride + c, weight, mixed, c);
    return mixed;
  };
}

/** Writes the direction between two of `vectors` to `result`, at `at`. */
function arc(vectors: readonly number[], a: number, b: number, weight: number, result: number[], at: number): void {
  const component = (i: number): number => vectors[i] ?? 0;
  const lengthA = Math.hypot(component(a), component(a + 1), component(a + 2)) || 1;
  const lengthB = Math.hypot(component(b), component(b + 1), component(b + 2)) || 1;
  let cosine = 0;
  for (let c = 0; c < 3; c++) cosine += (component(a + c) / lengthA) * (component(b + c) / lengthB);
  const angle = Math.acos(Math.max(-1, Math.min(1, cosine)));
  const sine = Math.sin(angle);
  const [weightA, weightB] =
    sine < 1e-6 ? [1 - weight, weight] : [Math.sin((1 - weight) * angle) / sine, Math.sin(weight * angle) / sine];
  for (let c = 0; c < 3; c++)
    result[at + c] = (weightA * component(a + c)) / lengthA + (weightB * component(b + c)) / lengthB;
}

function rotationsOf({ keys, values }: Curve): Rotation[] {
  return keys.map((_, i) => [
    values[4 * i] ?? 0,
    values[4 * i + 1] ?? 0,
    values[4 * i + 2] ?? 0,
    values[4 * i + 3] ?? 0,
  ]);
}

const identity: Quaternion = [0, 0, 0, 1];

/** Most things that turn do so about one axis: their angle is interpolated, which takes no trigonometry. */
function orientation(curve: Curve): Evaluation {
  const rotations = rotationsOf(curve);
  const turns = rotations.map((at, i) => turnBetween(at, rotations[i + 1] ?? at));
  const arcs = rotations.map((at, i) =>
    turns[i] ? undefined : arcBetween(quaternionOf(...at), quaternionOf(...(rotations[i + 1] ?? at))),
  );
  return (from, to, weight) => {
    const isBetween = from !== to && weight !== 0;
    const turn = isBetween ? turns[from] : undefined;
    if (turn) return [turn.axis[0], turn.axis[1], turn.axis[2], turn.angle + weight * turn.difference];
    const arc = isBetween ? arcs[from] : undefined;
    if (arc) return rotationOf(pointOf(arc, weight));
    return curve.values.slice(4 * from, 4 * from + 4); // as the author wrote it
  };
}

function squadOrientation(curve: Curve): Evaluation {
  const quaternions = rotationsOf(curve).map((rotation) => quaternionOf(...rotation));
  const last = quaternions.length - 1;
  const controls = quaternions.map((at, i) => {
    const [before, after] = [quaternions[i - 1], quaternions[i + 1]];
    return i === 0 || i === last || !before || !after ? at : squadControl(before, at, after);
  });
  return (from, to, weight) =>
    rotationOf(
      squad(
        quaternions[from] ?? identity,
        controls[from] ?? identity,
        controls[to] ?? identity,
        quaternions[to] ?? identity,
        weight,
      ),
    );
}

function spline({ keys, values, stride }: Curve, node: EventNode): Evaluation {
  const velocities = node.numbersOf("keyVelocity");
  const count = velocities.length / stride;
  const isUsable = count === 0 || count === 2 || count === keys.length;
  if (!isUsable) node.warn(`has ${count} velocities for ${keys.length} keys: they have no effect`);
  const fields = {
    keys,
    values,
    size: stride,
    velocities: isUsable ? velocities : [],
    isClosed: node.isTrue("closed"),
    normalizesVelocity: node.isTrue("normalizeVelocity"),
  };
  const tangents = tangentsOf(fields);
  return (from, to, weight) => {
    const value = splineValue(fields, tangents, from, to, weight);
    return stride === 1 ? (value[0] ?? 0) : value;
  };
}

/** The fraction of the way between two keys, which begins and ends slowly. */
function eased({ values }: Curve): Evaluation {
  return (from, to, weight) => {
    if (from === to) return from === 0 ? 0 : 1; // before the first key, or behind the last
    let out = values[2 * from + 1] ?? 0;
    let into = values[2 * to] ?? 0;
    const sum = out + into;
    if (sum <= 0) return weight;
    if (sum > 1) [out, into] = [out / sum, into / sum];
    const speed = 1 / (2 - out - into);
    if (weight < out) return (speed / out) * weight ** 2;
    if (weight <= 1 - into) return speed * (2 * weight - out);
    return 1 - (speed / into) * (1 - weight) ** 2;
  };
}

function interpolator(
  valueType: string,
  listType: string,
  interpolation: Interpolation,
  more: Readonly<Record<string, FieldSpecification>> = {},
): NodeType {
  const { output = "value_changed", valueField = "keyValue" } = interpolation;
  return nodeType(
    {
      set_fraction: inputOnly("SFFloat"),
      key: inputOutput("MFFloat", []),
      [valueField]: inputOutput(listType, []),
      ...more,
      [output]: outputOnly(valueType),
    },
    (node) => new Interpolator(node, interpolation),
  );
}

function splineInterpolator(valueType: string, listType: string, size: number): NodeType {
  return interpolator(
    valueType,
    listType,
    { size, evaluationOf: spline },
    {
      keyVelocity: inputOutput(listType, []),
      closed: initializeOnly("SFBool", false),
      normalizeVelocity: initializeOnly("SFBool", false),
    },
  );
}

export const interpolators = {
  ColorInterpolator: interpolator("SFColor", "MFColor", { size: 3, evaluationOf: color }),
  CoordinateInterpolator: nodeType(
    {
      set_fraction: inputOnly("SFFloat"),
      key: inputOutput("MFFloat", []),
      keyValue: inputOutput("MFVec3f", []),
      url: inputOutput("SFString", ""),
      value_changed: outputOnly("MFVec3f"),
      [sequenceFraction]: outputOnly("SFFloat"),
    },
    (node) => new CoordinateInterpolator(node, { size: 3, hasLists: true, evaluationOf: linear }),
  ),
  CoordinateInterpolator2D: interpolator("MFVec2f", "MFVec2f", { size: 2, hasLists: true, evaluationOf: linear }),
  EaseInEaseOut: interpolator("SFFloat", "MFVec2f", {
    size: 2,
    evaluationOf: eased,
    output: "modifiedFraction_changed",
    valueField: "easeInEaseOut",
  }),
  NormalInterpolator: interpolator("MFVec3f", "MFVec3f", { size: 3, hasLists: true, evaluationOf: normals }),
  OrientationInterpolator: interpolator("SFRotation", "MFRotation", { size: 4, evaluationOf: orientation }),
  PositionInterpolator: interpolator("SFVec3f", "MFVec3f", { size: 3, evaluationOf: linear }),
  PositionInterpolator2D: interpolator("SFVec2f", "MFVec2f", { size: 2, evaluationOf: linear }),
  ScalarInterpolator: interpolator("SFFloat", "MFFloat", { size: 1, evaluationOf: linearNumber }),
  SplinePositionInterpolator: splineInterpolator("SFVec3f", "MFVec3f", 3),
  SplinePositionInterpolator2D: splineInterpolator("SFVec2f", "MFVec2f", 2),
  SplineScalarInterpolator: splineInterpolator("SFFloat", "MFFloat", 1),
  SquadOrientationInterpolator: interpolator(
    "SFRotation",
    "MFRotation",
    { size: 4, evaluationOf: squadOrientation },
    { normalizeVelocity: initializeOnly("SFBool", false) },
  ),
} as const satisfies Readonly<Record<string, NodeType>>;
