// Concave polygons -> triangles, as src/import/triangulate.cpp cuts them: an ear is a
// convex corner whose triangle holds no other corner (Meisters, "Polygons have ears",
// 1975), and only reflex corners can lie in it (Eberly, "Triangulation by ear
// clipping", 2002).

type Point = readonly [number, number];

/** Polygons of more corners are cut as fans: the time grows with the square of them. */
const mostCorners = 512;

/**
 * The n - 2 triangles of a polygon of n corners, as places in `ring`: three numbers a
 * corner. Convex ones become fans about their first corner; those that cross
 * themselves or have no area still give as many.
 */
export function triangulate(ring: readonly (readonly [number, number, number])[]): number[] {
  const flat = projected(ring);
  return isConvex(flat) || ring.length > mostCorners ? fan(ring.length) : clipEars(flat);
}

function fan(corners: number): number[] {
  return Array.from({ length: Math.max(corners - 2, 0) }, (_, i) => [0, i + 1, i + 2]).flat();
}

/** Seen along the axis nearest to its normal (Newell's), counter-clockwise. */
function projected(ring: readonly (readonly [number, number, number])[]): Point[] {
  const normal = [0, 0, 0];
  ring.forEach((a, i) => {
    const b = ring[(i + 1) % ring.length] ?? a;
    normal[0] = (normal[0] ?? 0) + (a[1] - b[1]) * (a[2] + b[2]);
    normal[1] = (normal[1] ?? 0) + (a[2] - b[2]) * (a[0] + b[0]);
    normal[2] = (normal[2] ?? 0) + (a[0] - b[0]) * (a[1] + b[1]);
  });
  const size = (axis: number) => Math.abs(normal[axis] ?? 0);
  const axis = size(2) >= size(0) && size(2) >= size(1) ? 2 : size(1) >= size(0) ? 1 : 0;
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const isTurned = (normal[axis] ?? 0) < 0;
  return ring.map((point) => (isTurned ? [point[v] ?? 0, point[u] ?? 0] : [point[u] ?? 0, point[v] ?? 0]));
}

/** Twice the signed area of a triangle. */
function area(a: Point, b: Point, c: Point): number {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

const origin: Point = [0, 0];

function isConvex(flat: readonly Point[]): boolean {
  const at = (i: number) => flat[i % flat.length] ?? origin;
  return flat.every(
    (point, i) =>
      area(point, at(i + 1), at(i + 2)) >= 0 &&
      // Every corner of a star is convex too: it is told by its fan.
      (i === 0 || i + 1 >= flat.length || area(at(0), point, at(i + 1)) >= 0),
  );
}

function clipEars(flat: readonly Point[]): number[] {
  const left = flat.map((_, corner) => corner);
  const triangles: number[] = [];
  const cornerAt = (place: number) => left[place % left.length] ?? 0;
  const pointAt = (place: number) => flat[cornerAt(place)] ?? origin;
  const turn = (place: number) => area(pointAt(place + left.length - 1), pointAt(place), pointAt(place + 1));
  const isEar = (place: number): boolean => {
    if (turn(place) <= 0) return false;
    const [a, b, c] = [pointAt(place + left.length - 1), pointAt(place), pointAt(place + 1)];
    for (let other = place + 2; other < place + left.length - 1; ++other) {
      const p = pointAt(other);
      // Rings with a bridge to a hole pass twice through the bridge's ends.
      if ([a, b, c].some((q) => q[0] === p[0] && q[1] === p[1]) || turn(other) > 0) continue;
      if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
  };
  for (let place = 0, tried = 0; left.length > 2;) {
    // A polygon that crosses itself may have no ear: then any corner is cut off.
    if (tried < left.length && !isEar(place)) {
      place = (place + 1) % left.length;
      ++tried;
      continue;
    }
    triangles.push(cornerAt(place + left.length - 1), cornerAt(place), cornerAt(place + 1));
    left.splice(place, 1);
    place = (place + 1) % left.length; // the next corner over: neighbours in turn would make needles
    tried = 0;
  }
  return triangles;
}
