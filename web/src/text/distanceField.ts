// Converts a coverage image to a signed distance field, which keeps edges sharp under magnification (Green 2007,
// "Improved Alpha-Tested Magnification"). In a partly covered texel, the coverage and its gradient give the nearest
// point of the edge (Gustavson and Strand 2011, "Anti-aliased Euclidean distance transform"). Other texels search
// for the nearest edge point along columns, then along rows, within the range of the field.

/**
 * Edge points, by texel that the edge crosses: a point on the edge, in texels from the first texel's center, and the
 * inward normal.
 */
interface EdgePoints {
  readonly x: Float32Array;
  readonly y: Float32Array;
  readonly normalX: Float32Array;
  readonly normalY: Float32Array;
  /** By texel: its own index where the edge crosses it, else `none`. */
  readonly texels: Int32Array;
}

const none = -1;

/**
 * The field of `coverage` (0 … 255): 128 on the edge, up to 255 inside and down to 0 outside at `spread` texels from
 * the edge.
 */
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

/** The distance to an edge that is assumed to be straight within half a texel of its point. */
function distanceTo({ x, y, normalX, normalY }: EdgePoints, edge: number, column: number, row: number): number {
  if (edge === none) return Infinity;
  const dx = column - (x[edge] ?? 0),
    dy = row - (y[edge] ?? 0);
  const nx = normalX[edge] ?? 0,
    ny = normalY[edge] ?? 0;
  return Math.hypot(dx * nx + dy * ny, Math.max(Math.abs(dx * ny - dy * nx) - 0.5, 0));
}

/** Finds the edge in the texels that it crosses or touches. */
function edgesOf(coverage: Uint8Array, width: number, height: number): EdgePoints {
  const floats = () => new Float32Array(width * height);
  const edges: EdgePoints = {
    x: floats(),
    y: floats(),
    normalX: floats(),
    normalY: floats(),
    texels: new Int32Array(width * height).fill(none),
  };
  const clamped = (index: number, length: number) => (index < 0 ? 0 : index < length ? index : length - 1);
  const at = (column: number, row: number) => coverage[clamped(row, height) * width + clamped(column, width)] ?? 0;
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      const texel = row * width + column;
      const covered = coverage[texel] ?? 0;
      if (covered === 0) continue;
      const [left, right, up, down] = [
        at(column - 1, row),
        at(column + 1, row),
        at(column, row - 1),
        at(column, row + 1),
      ];
      if (covered === 255 && left > 0 && right > 0 && up > 0 && down > 0) continue;
      // Sobel gradients, with weights for edges of any direction.
      const rising = at(column + 1, row + 1) - at(column - 1, row - 1),
        falling = at(column + 1, row - 1) - at(column - 1, row + 1);
      const slopeX = rising + falling + Math.SQRT2 * (right - left),
        slopeY = rising - falling + Math.SQRT2 * (down - up);
      const length = Math.hypot(slopeX, slopeY);
      if (length === 0) continue; // a line thinner than its texel
      const nx = slopeX / length,
        ny = slopeY / length;
      const inwards = distanceToEdge(covered / 255, Math.abs(nx), Math.abs(ny));
      edges.texels[texel] = texel;
      [edges.normalX[texel], edges.normalY[texel]] = [nx, ny];
      [edges.x[texel], edges.y[texel]] = [column + inwards * nx, row + inwards * ny];
    }
  }
  return edges;
}

/**
 * The signed distance from the center of a square to a straight edge with this normal that leaves `share` of the square
 * covered; negative where the center is covered.
 */
function distanceToEdge(share: number, normalX: number, normalY: number): number {
  const [long, short] = [Math.max(normalX, normalY), Math.min(normalX, normalY)];
  const smallerShare = Math.min(share, 1 - share);
  // The covered area is a triangle at a corner, or a trapezoid.
  const distance =
    2 * long * smallerShare < short
      ? (long + short) / 2 - Math.sqrt(2 * long * short * smallerShare)
      : (0.5 - smallerShare) * long;
  return share > 0.5 ? -distance : distance;
}

/** By texel: the nearest of the edges known to the texels of its row or column, which are `stride` apart. */
function nearestAlong(
  { x, y }: EdgePoints,
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
      let minSquare = Infinity;
      const consider = (edge: number) => {
        const dx = (x[edge] ?? 0) - column,
          dy = (y[edge] ?? 0) - row;
        if (dx * dx + dy * dy >= minSquare) return;
        minSquare = dx * dx + dy * dy;
        nearest[texel] = edge;
      };
      // An edge point is less than a texel from the center of its texel.
      for (let offset = 0; offset <= spread && (offset < 2 || (offset - 1) * (offset - 1) < minSquare); ++offset) {
        const left = offset <= before ? (known[texel - offset * stride] ?? none) : none,
          right = offset <= after ? (known[texel + offset * stride] ?? none) : none;
        if (left !== none) consider(left);
        if (right !== none) consider(right);
      }
    }
  }
  return nearest;
}
