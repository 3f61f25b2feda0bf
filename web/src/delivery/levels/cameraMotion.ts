// Where cameras will be shortly if they go on as they move: levels of detail that they will need are requested before.

import type { Camera, Point } from "../../scheduler/viewMetrics.ts";
import type { SceneView } from "../../levels/levelViews.ts";

/** A camera that has not moved for this time, in milliseconds, rests. Views follow a moving one every 100 ms. */
const restTime = 300;
/** Views that follow each other in less than this time, in milliseconds, are of the same movement. */
const minInterval = 16;

type Plane = Camera["planes"][number];

interface Sample {
  readonly views: readonly SceneView[];
  /** In milliseconds. */
  readonly time: number;
}

/** The movement of cameras, of which views are given whenever they may have moved. */
export class CameraMotion {
  #before: Sample | undefined;
  #last: Sample | undefined;
  /** Whether cameras had moved already between the views before these two: a single step is a jump. */
  #goesOn = false;

  follow(views: readonly SceneView[], time: number): void {
    const last = this.#last;
    if (last?.views.length !== views.length) {
      this.#rest({ views, time });
      return;
    }
    const hasMoved = views.some((view, n) => !isSameView(view, last.views[n]));
    if (time - last.time > restTime) this.#rest({ views, time: hasMoved ? time : last.time });
    else if (hasMoved && time - last.time < minInterval) this.#last = { views, time: last.time };
    else if (hasMoved) {
      this.#goesOn = this.#before !== undefined;
      this.#before = last;
      this.#last = { views, time };
    }
  }

  /** The views after the last ones in `duration` milliseconds; none where the cameras rest. */
  viewsAhead(duration: number): readonly SceneView[] {
    const [before, last] = [this.#before, this.#last];
    if (!this.#goesOn || before === undefined || last === undefined) return [];
    const factor = duration / (last.time - before.time);
    return last.views.map((view, n) => {
      const previous = before.views[n];
      return previous ? { ...view, camera: cameraAhead(previous.camera, view.camera, factor) } : view;
    });
  }

  #rest(sample: Sample): void {
    this.#before = undefined;
    this.#goesOn = false;
    this.#last = sample;
  }
}

/** The camera after `factor` further movements like that from `before` to `camera`. */
function cameraAhead(before: Camera, camera: Camera, factor: number): Camera {
  const position = pointAhead(before.position, camera.position, factor);
  const planes = camera.planes.map((plane, n) => {
    const [x, y, z] = directionAhead(before.planes[n] ?? plane, plane, factor);
    // As far from the eye as the plane is now.
    const [eyeX, eyeY, eyeZ] = camera.position;
    const distance = plane[0] * eyeX + plane[1] * eyeY + plane[2] * eyeZ + plane[3];
    return [x, y, z, distance - (x * position[0] + y * position[1] + z * position[2])] as const;
  });
  return { ...camera, position, planes };
}

function pointAhead(before: Point, now: Point, factor: number): Point {
  const along = (axis: 0 | 1 | 2): number => now[axis] + factor * (now[axis] - before[axis]);
  return [along(0), along(1), along(2)];
}

/** The normal of a plane, of length 1. */
function directionAhead([x0, y0, z0]: Plane, [x, y, z]: Plane, factor: number): Point {
  const [aheadX, aheadY, aheadZ] = pointAhead([x0, y0, z0], [x, y, z], factor);
  const length = Math.hypot(aheadX, aheadY, aheadZ);
  return length > 0 ? [aheadX / length, aheadY / length, aheadZ / length] : [x, y, z];
}

function isSameView(a: SceneView, b: SceneView | undefined): boolean {
  if (b === undefined) return false;
  const isSameCamera =
    isSameList(a.camera.position, b.camera.position) &&
    a.camera.planes.every((plane, n) => isSameList(plane, b.camera.planes[n] ?? []));
  return isSameCamera && isSameList(a.worldFromScene ?? [], b.worldFromScene ?? []);
}

function isSameList(a: ArrayLike<number>, b: ArrayLike<number>): boolean {
  if (a.length !== b.length) return false;
  for (let n = 0; n < a.length; ++n) if (a[n] !== b[n]) return false;
  return true;
}
