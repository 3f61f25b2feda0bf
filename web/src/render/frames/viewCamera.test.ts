import assert from "node:assert/strict";
import { test } from "node:test";
import { Sphere, Vector3 } from "three";
import type { Pose } from "../../navigation/cameraPose.ts";
import { poseFraming } from "../../navigation/cameraPose.ts";
import { ViewCamera } from "./viewCamera.ts";

const sphere = new Sphere(new Vector3(3, 0, 0), 2);

/** A camera, and a function that moves its controller by a distance along x. */
function makeCamera(): { camera: ViewCamera; move: (distance: number) => void } {
  let pose: Pose = poseFraming(sphere);
  const controller = {
    get pose() {
      return pose;
    },
    clearance: 0.1,
    isMoving: false,
    advance: () => pose,
  };
  const move = (distance: number): void => {
    pose = { ...pose, position: pose.position.clone().add(new Vector3(distance, 0, 0)) };
  };
  return { camera: new ViewCamera(controller), move };
}

/** Where the camera of the last frame displays a point, -1 … 1. */
function projected(camera: ViewCamera, point: Vector3): Vector3 {
  return point.clone().project(camera.drawn);
}

function drawFrame(camera: ViewCamera): void {
  camera.advance(0, sphere);
  camera.current.updateMatrixWorld();
  camera.keep();
}

test("a canvas without area has no view, and keeps its pixel ratio", () => {
  const { camera } = makeCamera();
  assert.equal(camera.viewOf(sphere), undefined);
  camera.setSize(200, 100, 2);
  assert.ok(camera.viewOf(sphere));
  camera.setSize(0, 100, 3);
  assert.equal(camera.viewOf(sphere), undefined);
  assert.equal(camera.pixelRatio.value, 2);
});

test("the view is where the controller has the camera now; the camera of the last frame stays until the next", () => {
  const { camera, move } = makeCamera();
  camera.setSize(200, 100, 1);
  assert.ok(!camera.isDrawn);
  drawFrame(camera);
  assert.ok(camera.isDrawn);
  const [before] = camera.viewOf(sphere)?.position ?? [];
  assert.ok(before !== undefined);
  move(1);
  assert.ok(Math.abs((camera.viewOf(sphere)?.position[0] ?? 0) - before - 1) < 1e-9);
  assert.equal(camera.drawn.position.x, before);
  drawFrame(camera);
  assert.ok(Math.abs(camera.drawn.position.x - before - 1) < 1e-9);
});

test("the depths of a frame are those of its camera's planes, around the sphere", () => {
  const { camera } = makeCamera();
  camera.setSize(200, 100, 1);
  drawFrame(camera);
  const { x: near, y: far } = camera.depthRange.value;
  assert.deepEqual([near, far], [camera.drawn.near, camera.drawn.far]);
  const distance = camera.drawn.position.distanceTo(sphere.center);
  assert.ok(near > 0 && near <= distance - sphere.radius && far >= distance + sphere.radius);
});

test("a ray through the point of the canvas that displays a point of the scene meets it", () => {
  const { camera } = makeCamera();
  camera.setSize(300, 100, 1);
  drawFrame(camera);
  const point = new Vector3(3.5, 0.7, -0.4);
  const { x, y } = projected(camera, point);
  const ray = camera.rayAt(x, y);
  const [origin, direction] = [new Vector3(...ray.origin), new Vector3(...ray.direction)];
  const toPoint = point.clone().sub(origin);
  const atPoint = origin.clone().addScaledVector(direction, toPoint.length());
  assert.ok(atPoint.distanceTo(point) < 1e-6 * toPoint.length());
});

test("the camera carries the headlight, which shines where it looks", () => {
  const { camera } = makeCamera();
  camera.setSize(100, 100, 1);
  drawFrame(camera);
  const { headlight, current } = camera;
  const direction = headlight.target.getWorldPosition(new Vector3()).sub(headlight.getWorldPosition(new Vector3()));
  assert.ok(direction.normalize().distanceTo(current.getWorldDirection(new Vector3())) < 1e-9);
});
