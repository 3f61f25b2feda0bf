// Image operators as geometry operators (paper, section 7.4): they map points of the geometry's box, whose coordinates
// are 0 … 1 as those of an image's channels. `render/shaders/operatorChunk.ts` does the same in the shader,
// `src/scene/operators.h` in the converter; vectors/operators.json binds it.

import type { Vec3 } from "./fieldTypes.ts";
import type { Box3 } from "./geometryDescription.ts";

/**
 * What happens to a coordinate c of each axis. `affine`: a c + b. `power`: max(c, 0)^a. `fold`: c beyond a is mirrored
 * at a. `clamp`: a … b. `steps`: to the nearest multiple of 1 / a. `permute`: axis n gets the coordinate of axis a[n].
 * `blur`: a[0] is its radius in texels; it filters the image of the points, and a point alone stays.
 */
export interface Operator {
  readonly kind: "affine" | "power" | "fold" | "clamp" | "steps" | "permute" | "blur";
  readonly a: Vec3;
  readonly b: Vec3;
}

export const maxOperators = 16;
/** In texels: a vertex is the mean of at most 9 x 9. */
export const maxBlurRadius = 4;

/** What a list of operators does to the front side of triangles. */
export type Orientation = "kept" | "flipped" | "folded";

/** The radius of a list's blur, which is its first operator; 0 without one. */
export function blurRadiusOf([first]: readonly Operator[]): number {
  return first?.kind === "blur" ? first.a[0] : 0;
}

/** Maps a point of the unit box. */
export function operatedPoint(operators: readonly Operator[], point: Vec3): Vec3 {
  return operators.reduce<Vec3>(
    (c, operator) => [axisOf(operator, c, 0), axisOf(operator, c, 1), axisOf(operator, c, 2)],
    point,
  );
}

function axisOf(operator: Operator, c: Vec3, axis: 0 | 1 | 2): number {
  return operator.kind === "permute" ? (c[operator.a[axis]] ?? 0) : mapped(operator, c[axis], axis);
}

function mapped({ kind, a, b }: Operator, c: number, axis: 0 | 1 | 2): number {
  switch (kind) {
    case "affine":
      return a[axis] * c + b[axis];
    case "power":
      return Math.max(c, 0) ** a[axis];
    case "fold":
      return c > a[axis] ? 2 * a[axis] - c : c;
    case "clamp":
      return Math.min(Math.max(c, a[axis]), b[axis]);
    case "steps":
      return Math.floor(c * a[axis] + 0.5) / a[axis];
    case "permute":
    case "blur":
      return c;
  }
}

/** A box around the images of all points of a box. */
export function operatedBox(operators: readonly Operator[], { min, max }: Box3): Box3 {
  return operators.reduce<Box3>(
    (box, operator) => {
      const range = (axis: 0 | 1 | 2): readonly [number, number] => {
        const from = operator.kind === "permute" ? (operator.a[axis] as 0 | 1 | 2) : axis;
        const ends = [box.min[from], box.max[from]];
        // The image of an interval ends in images of its ends and of the only turning point.
        if (
          operator.kind === "fold" &&
          ends.every((end, n) => (n === 0 ? end < operator.a[axis] : end > operator.a[axis]))
        )
          ends.push(operator.a[axis]);
        const images = ends.map((end) => mapped(operator, end, axis));
        return [Math.min(...images), Math.max(...images)];
      };
      const [x, y, z] = [range(0), range(1), range(2)];
      return { min: [x[0], y[0], z[0]], max: [x[1], y[1], z[1]] };
    },
    { min, max },
  );
}

/** `folded`: triangles keep or lose their front side depending on where they lie. */
export function orientationOf(operators: readonly Operator[]): Orientation {
  if (operators.some(({ kind }) => kind === "fold")) return "folded";
  const flips = operators.filter(({ kind, a: [x, y, z] }) =>
    kind === "permute" ? isOdd([x, y, z]) : kind === "affine" && x * y * z < 0,
  );
  return flips.length % 2 === 1 ? "flipped" : "kept";
}

/** Whether a permutation of the axes exchanges two, so that it mirrors. */
export function isOdd([x, y, z]: Vec3): boolean {
  return (y - x) * (z - x) * (z - y) < 0;
}
