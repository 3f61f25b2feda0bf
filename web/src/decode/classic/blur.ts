// The operator blur of docs/formats/nodes.md: a filter on the image of a patch's coordinates. src/containers/blur.h
// does the same, and vectors/blur.json tests both; where vertices come from images the vertex shader does it
// (render/shaders/vertexChunk.ts).

/** Points in rows of `columns`, of which the last may be shorter; x, y and z follow each other. */
export interface PointImage {
  readonly points: Readonly<ArrayLike<number>>;
  readonly columns: number;
  /** The last column is joined to the first. */
  readonly isClosed: boolean;
}

/**
 * The weighted mean of the neighbours of each point, ceil(radius) to each side along rows and columns, with the weights
 * of a Gaussian whose standard deviation is radius / 2. Near an end of a row or column there are fewer, as many on both
 * sides: corners stay, and a border is filtered along itself, so that surfaces that have the same points there still
 * meet.
 */
export function blurred({ points, columns, isClosed }: PointImage, radius: number): Float64Array {
  const result = Float64Array.from(points);
  if (!(radius > 0)) return result;
  const weights = Array.from({ length: Math.ceil(radius) + 1 }, (_, d) => Math.exp((-2 * d * d) / (radius * radius)));
  const count = points.length / 3;
  const rows = Math.floor(count / columns);
  const rest = count % columns;
  const line = new Float64Array(3 * Math.max(columns, rows));
  const filter = (first: number, step: number, length: number, closed: boolean) => {
    for (let i = 0; i < length; ++i)
      for (let axis = 0; axis < 3; ++axis) line[3 * i + axis] = result[3 * (first + i * step) + axis] ?? 0;
    filterLine(line, length, closed, weights, (i, axis, value) => (result[3 * (first + i * step) + axis] = value));
  };
  for (let row = 0; row < rows; ++row) filter(row * columns, 1, columns, isClosed);
  if (rest > 0) filter(rows * columns, 1, rest, false);
  for (let column = 0; column < columns && rows > 0; ++column) filter(column, columns, rows, false);
  return result;
}

function filterLine(
  line: Float64Array,
  length: number,
  isClosed: boolean,
  weights: readonly number[],
  set: (i: number, axis: number, value: number) => void,
): void {
  const last = weights.length - 1;
  for (let i = 0; i < length; ++i) {
    const reach = isClosed ? last : Math.min(last, i, length - 1 - i);
    for (let axis = 0; axis < 3; ++axis) {
      let sum = (line[3 * i + axis] ?? 0) * (weights[0] ?? 0);
      let total = weights[0] ?? 0;
      for (let d = 1; d <= reach; ++d) {
        const left = (i + length - (d % length)) % length;
        const right = (i + d) % length;
        sum += ((line[3 * left + axis] ?? 0) + (line[3 * right + axis] ?? 0)) * (weights[d] ?? 0);
        total += 2 * (weights[d] ?? 0);
      }
      set(i, axis, sum / total);
    }
  }
}
