// From how much of each texel a shape covers to how far its edge is: seen large, an
// edge between two texels is then where it was (Green 2007, "Improved Alpha-Tested
// Magnification"). Where a texel is covered in part, its share and the slope of the
// shares around it tell the nearest point of the edge (Gustavson and Strand 2011,
// "Anti-aliased Euclidean distance transform"); the others find theirs along columns,
// then along rows, no farther than distances count.

/** Where the edge runs in each of some texels: a point of it, in texels from the first one's centre, and its normal, inwards. */
interface Edges {
  readonly x: Float32Array;
  readonly y: Float32Array;
  readonly normalX: Float32Array;
  readonly normalY: Float32Array;
  /** By texel itself, or none. */
  readonly texels: Int32Array;
}

const none = -1;

/** By texel of `coverage`, 0 … 255: 128 on the edge, more inside, less outside; `spread` texels away it is all or nothing. */
export function distanceField(
  coverage: Uint8Array,
  width: number,
  height: number,
  spread: number,
): Uint8Array<ArrayBuffer> {
  const edges = edgesOf(coverage, width, height);
  const inColumns = nearestAlong(edges, edges.texels, width, height, spread, width);
  const nearest = nearestAlong(edges, inColumns, width, height, spread, 1);
  const field = new Uint8Array(width * height);
  for (let texel = 0; texel < field.length; ++texel) {
    const isInside = (coverage[texel] ?? 0) > 127;
    const distance = Math.min(
      distanceTo(edges, nearest[texel] ?? none, texel % width, Math.floor(texel / width)),
      spread,
    );
    field[texel] = Math.round(255 * (0.5 + (isInside ? distance : -distance) / (2 * spread)));
  }
  return field;
}

/** The edge is taken to be straight half a texel to both sides of its point. */
function distanceTo({ x, y, normalX, normalY }: Edges, edge: number, column: number, row: number): number {
  if (edge === none) return Infinity;
  const dx = column - (x[edge] ?? 0),
    dy = row - (y[edge] ?? 0);
  const nx = normalX[edge] ?? 0,
    ny = normalY[edge] ?? 0;
  return Math.hypot(dx * nx + dy * ny, Math.max(Math.abs(dx * ny - dy * nx) - 0.5, 0));
}

/** Of texels that the edge runs through, or along. */
function edgesOf(coverage: Uint8Array, width: number, height: number): Edges {
  const numbers = () => new Float32Array(width * height);
  const edges: Edges = {
    x: numbers(),
    y: numbers(),
    normalX: numbers(),
    normalY: numbers(),
    texels: new Int32Array(width * height).fill(none),
  };
  const clamped = (place: number, length: number) => (place < 0 ? 0 : place < length ? place : length - 1);
  const at = (column: number, row: number) => coverage[clamped(row, height) * width + clamped(column, width)] ?? 0;
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      const texel = row * width + column;
      const share = coverage[texel] ?? 0;
      if (share === 0) continue;
      const [left, right, up, down] = [
        at(column - 1, row),
        at(column + 1, row),
        at(column, row - 1),
        at(column, row + 1),
      ];
      if (share === 255 && left > 0 && right > 0 && up > 0 && down > 0) continue;
      // Sobel's slopes, with weights that suit edges of any direction.
      const rising = at(column + 1, row + 1) - at(column - 1, row - 1),
        falling = at(column + 1, row - 1) - at(column - 1, row + 1);
      const slopeX = rising + falling + Math.SQRT2 * (right - left),
        slopeY = rising - falling + Math.SQRT2 * (down - up);
      const length = Math.hypot(slopeX, slopeY);
      if (length === 0) continue; // a hair, thinner than its texel
      const nx = slopeX / length,
        ny = slopeY / length;
      const inwards = distanceToEdge(share / 255, Math.abs(nx), Math.abs(ny));
      edges.texels[texel] = texel;
      [edges.normalX[texel], edges.normalY[texel]] = [nx, ny];
      [edges.x[texel], edges.y[texel]] = [column + inwards * nx, row + inwards * ny];
    }
  }
  return edges;
}

/** From the centre of a square to a straight edge that leaves `share` of it covered, by the edge's normal; less than 0: the centre is covered. */
function distanceToEdge(share: number, normalX: number, normalY: number): number {
  const [long, short] = [Math.max(normalX, normalY), Math.min(normalX, normalY)];
  const lesser = Math.min(share, 1 - share);
  // Either a triangle at a corner is covered, or what is between two parallel sides.
  const distance =
    2 * long * lesser < short ? (long + short) / 2 - Math.sqrt(2 * long * short * lesser) : (0.5 - lesser) * long;
  return share > 0.5 ? -distance : distance;
}

/** By texel the nearest of the edges that it and the texels of its line know, `stride` apart. */
function nearestAlong(
  { x, y }: Edges,
  known: Int32Array,
  width: number,
  height: number,
  spread: number,
  stride: number,
): Int32Array {
  const nearest = new Int32Array(known);
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      const texel = row * width + column;
      const before = Math.min(stride === 1 ? column : row, spread),
        after = Math.min(stride === 1 ? width - 1 - column : height - 1 - row, spread);
      let least = Infinity;
      const consider = (edge: number) => {
        const dx = (x[edge] ?? 0) - column,
          dy = (y[edge] ?? 0) - row;
        if (dx * dx + dy * dy >= least) return;
        least = dx * dx + dy * dy;
        nearest[texel] = edge;
      };
      // A point is less than a texel from the centre of its own.
      for (let away = 0; away <= spread && (away < 2 || (away - 1) * (away - 1) < least); ++away) {
        const left = away <= before ? (known[texel - away * stride] ?? none) : none,
          right = away <= after ? (known[texel + away * stride] ?? none) : none;
        if (left !== none) consider(left);
        if (right !== none) consider(right);
      }
    }
  }
  return nearest;
}
