// The Catmull-Rom splines of X3D's spline interpolators (ISO/IEC 19775-1, 19.2.4), for values of any number of
// components.

export interface SplineFields {
  readonly keys: readonly number[];
  /** Flat: `size` numbers for each key. */
  readonly values: readonly number[];
  readonly size: number;
  /** Flat: none, one vector for each key, or the first and the last one. */
  readonly velocities: readonly number[];
  /** The first and the last value are the same, and the curve is smooth there. */
  readonly isClosed: boolean;
  readonly normalizesVelocity: boolean;
}

/** The tangents of each key, where the curve leaves it and where it arrives. Flat, as the values. */
export interface SplineTangents {
  readonly leaving: readonly number[];
  readonly arriving: readonly number[];
}

export function tangentsOf(fields: SplineFields): SplineTangents {
  const { keys, values, size, velocities } = fields;
  const last = keys.length - 1;
  const isClosed = fields.isClosed && isLoop(fields);
  const tangents = velocities.length === 0 ? chords(fields, isClosed) : givenVelocities(fields);
  const leaving: number[] = [];
  const arriving: number[] = [];
  for (let i = 0; i <= last; i++) {
    const [before, after] =
      i > 0 && i < last ? [i - 1, i + 1] : isClosed && last > 0 ? [last - 1, 1] : [undefined, undefined];
    let [plus, minus] = [1, 1];
    if (before !== undefined) {
      const at = keys[i] ?? 0;
      const past = i === 0 ? (keys[last] ?? 0) - (keys[before] ?? 0) : at - (keys[before] ?? 0);
      const next = i === last ? (keys[after] ?? 0) - (keys[0] ?? 0) : (keys[after] ?? 0) - at;
      if (past + next > 0) [plus, minus] = [(2 * past) / (past + next), (2 * next) / (past + next)];
    }
    for (let c = 0; c < size; c++) {
      const tangent = tangents[i * size + c] ?? 0;
      leaving.push(plus * tangent);
      arriving.push(minus * tangent);
    }
  }
  return { leaving, arriving };

  function isLoop(spline: SplineFields): boolean {
    return Array.from({ length: spline.size }, (_, c) => c).every((c) => values[c] === values[last * size + c]);
  }
}

/** Half of the chord from the key before to the key after; none at the ends of an open curve. */
function chords({ keys, values, size }: SplineFields, isClosed: boolean): number[] {
  const last = keys.length - 1;
  return keys.flatMap((_, i) => {
    const isEnd = i === 0 || i === last;
    if (isEnd && (!isClosed || last === 0)) return Array.from({ length: size }, () => 0);
    const [before, after] = isEnd ? [last - 1, 1] : [i - 1, i + 1];
    return Array.from(
      { length: size },
      (__, c) => ((values[after * size + c] ?? 0) - (values[before * size + c] ?? 0)) / 2,
    );
  });
}

function givenVelocities({ keys, values, size, velocities, normalizesVelocity }: SplineFields): number[] {
  const last = keys.length - 1;
  const onlyEnds = velocities.length === 2 * size && last > 1;
  const at = (i: number, c: number): number => velocities[i * size + c] ?? 0;
  const inner = onlyEnds ? chords({ keys, values, size, velocities, normalizesVelocity, isClosed: false }, false) : [];
  const tangents = keys.flatMap((_, i) =>
    Array.from({ length: size }, (__, c) =>
      !onlyEnds ? at(i, c) : i === 0 ? at(0, c) : i === last ? at(1, c) : (inner[i * size + c] ?? 0),
    ),
  );
  if (!normalizesVelocity) return tangents;
  let total = 0;
  for (let i = 0; i < last; i++)
    total += Math.hypot(
      ...Array.from({ length: size }, (_, c) => (values[(i + 1) * size + c] ?? 0) - (values[i * size + c] ?? 0)),
    );
  return keys.flatMap((_, i) => {
    const tangent = tangents.slice(i * size, (i + 1) * size);
    const length = Math.hypot(...tangent);
    return length === 0 ? tangent : tangent.map((component) => (component * total) / length);
  });
}

/** The value at `t`, 0 … 1, between two keys. */
export function splineValue(
  { values, size }: SplineFields,
  { leaving, arriving }: SplineTangents,
  from: number,
  to: number,
  t: number,
): number[] {
  const h1 = (1 + 2 * t) * (1 - t) ** 2;
  const h2 = t ** 2 * (3 - 2 * t);
  const h3 = t * (1 - t) ** 2;
  const h4 = t ** 2 * (t - 1);
  return Array.from({ length: size }, (_, c) => {
    const [a, b] = [from * size + c, to * size + c];
    return h1 * (values[a] ?? 0) + h2 * (values[b] ?? 0) + h3 * (leaving[a] ?? 0) + h4 * (arriving[b] ?? 0);
  });
}
