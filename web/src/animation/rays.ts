// Where the ray through a pointer meets the shapes that drag sensors track: planes, spheres and cylinders.

export type Point = readonly [x: number, y: number, z: number];

/** From the viewer into the scene. `direction` has any length but 0. */
export interface Ray {
  readonly origin: Point;
  readonly direction: Point;
}

function at({ origin, direction }: Ray, t: number): Point {
  return [origin[0] + t * direction[0], origin[1] + t * direction[1], origin[2] + t * direction[2]];
}

/** The point in the plane where coordinate `axis` is `value`; undefined where the ray is parallel or leads away. */
export function onPlane(ray: Ray, axis: 0 | 1 | 2, value: number): Point | undefined {
  const t = (value - ray.origin[axis]) / ray.direction[axis];
  return Number.isFinite(t) && t > 0 ? at(ray, t) : undefined;
}

/** The smaller solution of a t² + 2 b t + c = 0; where there is none, the t at which the polynomial is smallest. */
function nearestRoot(a: number, b: number, c: number): { t: number; isHit: boolean } {
  const discriminant = b * b - a * c;
  return discriminant >= 0 ? { t: (-b - Math.sqrt(discriminant)) / a, isHit: true } : { t: -b / a, isHit: false };
}

/** The point of a sphere around the origin that the ray hits first, or else passes nearest to. */
export function onSphere(ray: Ray, radius: number): Point {
  const { origin: o, direction: d } = ray;
  const dot = (u: Point, v: Point): number => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const { t, isHit } = nearestRoot(dot(d, d), dot(o, d), dot(o, o) - radius * radius);
  const point = at(ray, t);
  const length = Math.hypot(...point);
  if (isHit || length === 0) return point;
  return [(point[0] * radius) / length, (point[1] * radius) / length, (point[2] * radius) / length];
}

/** The same for a cylinder around the y axis without ends; undefined for a ray along the axis. */
export function onCylinder(ray: Ray, radius: number): Point | undefined {
  const { origin: o, direction: d } = ray;
  const a = d[0] * d[0] + d[2] * d[2];
  if (a === 0) return undefined;
  const { t, isHit } = nearestRoot(a, o[0] * d[0] + o[2] * d[2], o[0] * o[0] + o[2] * o[2] - radius * radius);
  const point = at(ray, t);
  const length = Math.hypot(point[0], point[2]);
  if (isHit || length === 0) return point;
  return [(point[0] * radius) / length, point[1], (point[2] * radius) / length];
}
