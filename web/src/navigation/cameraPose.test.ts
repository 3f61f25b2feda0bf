import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Box3, MathUtils, Matrix4, PerspectiveCamera, Sphere, Vector3 } from "three";
import type { ViewpointDescription } from "../document/description.ts";
import type { Pose } from "./cameraPose.ts";
import { applyPose, panPose, poseFraming, poseOfViewpoint, poseShowingAll, orbitPose, zoomPose } from "./cameraPose.ts";

const sphere = new Sphere(new Vector3(3, -2, 5), 4);
const start = poseFraming(sphere);

function assertNear(actual: number, expected: number, tolerance = 1e-9): void {
  assert.ok(Math.abs(actual - expected) <= tolerance * Math.max(1, Math.abs(expected)), `${actual} is not ${expected}`);
}

function forward(pose: Pose): Vector3 {
  return new Vector3(0, 0, -1).applyQuaternion(pose.orientation);
}

function projected(pose: Pose, aspect: number, point: Vector3): Vector3 {
  const camera = new PerspectiveCamera();
  applyPose(camera, pose, aspect, sphere);
  camera.updateMatrixWorld();
  return point.clone().project(camera);
}

/** Points all over the sphere's surface. */
const surface = Array.from({ length: 200 }, (_, n) => {
  const y = 1 - (2 * n + 1) / 200;
  const angle = n * 2.399963;
  const radius = Math.sqrt(1 - y * y);
  return new Vector3(radius * Math.cos(angle), y, radius * Math.sin(angle))
    .multiplyScalar(sphere.radius)
    .add(sphere.center);
});

describe("a pose that frames the scene", () => {
  for (const aspect of [0.4, 1, 2.5]) {
    test(`sees all of it at an aspect of ${aspect}, within the depth range`, () => {
      for (const point of surface) {
        const { x, y, z } = projected(start, aspect, point);
        assert.ok(
          [x, y, z].every((value) => Math.abs(value) <= 1),
          `${x} ${y} ${z}`,
        );
      }
    });
  }

  test("looks at its center, and so does the pose that shows all after movement", () => {
    for (const pose of [
      start,
      poseShowingAll(panPose(orbitPose(zoomPose(start, 0.1, sphere), 1, 0.3), 3, 1), sphere),
    ]) {
      assertNear(forward(pose).angleTo(sphere.center.clone().sub(pose.position)), 0, 1e-7);
    }
  });
});

test("a scene at the side of the view is within the depth range, as one in the middle is", () => {
  for (const shift of [0.5, 1, 2, 5])
    for (const point of surface) {
      const { z } = projected(panPose(start, shift, -shift / 2), 1, point);
      assert.ok(Math.abs(z) <= 1, `moved by ${shift}: ${z}`);
    }
});

describe("a viewpoint", () => {
  const fields = {
    set_bind: false,
    bind: false,
    description: "",
    position: [0, 0, 10],
    orientation: [0, 0, 1, 0],
    fieldOfView: 1,
    centerOfRotation: [0, 0, 0],
  } as const;
  const poseOf = (changes: Partial<ViewpointDescription>, sceneFromViewpoint = new Matrix4()) =>
    poseOfViewpoint({ viewpoint: { ...fields, ...changes }, sceneFromViewpoint });

  test("shows all of a field of view with an aspect ratio in a canvas of any shape", () => {
    for (const [aspect, width, height] of [
      [1.5, 1.5, 1],
      [4 / 3, 1.5, 1.125],
      [3, 3, 1],
      [0.5, 1.5, 3],
    ] as const) {
      const camera = new PerspectiveCamera();
      applyPose(camera, poseOf({ aspectRatio: 1.5 }), aspect, sphere);
      assertNear(Math.tan(MathUtils.degToRad(camera.fov) / 2), height * Math.tan(0.5));
      assertNear(height * aspect, width);
    }
  });

  test("has its field of view along the shorter side", () => {
    const camera = new PerspectiveCamera();
    applyPose(camera, poseOf({}), 2, sphere);
    assertNear(MathUtils.degToRad(camera.fov), 1);
    applyPose(camera, poseOf({}), 0.5, sphere);
    const horizontal = 2 * Math.atan(Math.tan(MathUtils.degToRad(camera.fov) / 2) * 0.5);
    assertNear(horizontal, 1);
  });

  test("looks along -z of its orientation", () => {
    const pose = poseOf({ orientation: [0, 2, 0, Math.PI / 2] });
    assertNear(forward(pose).distanceTo(new Vector3(-1, 0, 0)), 0);
  });

  test("is moved and turned by the transforms around it", () => {
    const matrix = new Matrix4()
      .makeTranslation(5, 0, 0)
      .multiply(new Matrix4().makeRotationY(Math.PI / 2))
      .multiply(new Matrix4().makeScale(2, 2, 2));
    const pose = poseOf({ centerOfRotation: [0, 0, 1] }, matrix);
    assertNear(pose.position.distanceTo(new Vector3(25, 0, 0)), 0);
    assertNear(pose.center.distanceTo(new Vector3(7, 0, 0)), 0);
    assertNear(forward(pose).distanceTo(new Vector3(-1, 0, 0)), 0);
  });

  test("stands upright when it looks down from above, and keeps its own up when it is tilted", () => {
    assertNear(poseOf({ orientation: [1, 0, 0, -0.5] }).up.distanceTo(new Vector3(0, 1, 0)), 0);
    assertNear(
      poseOf({ orientation: [1, 0, 0, -0.5] }, new Matrix4().makeRotationX(1)).up.distanceTo(
        new Vector3(0, Math.cos(1), Math.sin(1)),
      ),
      0,
    );
    assertNear(poseOf({ orientation: [0, 0, 1, 0.4] }).up.distanceTo(new Vector3(-Math.sin(0.4), Math.cos(0.4), 0)), 0);
    assertNear(poseOf({ orientation: [1, 0, 0, -Math.PI / 2] }).up.distanceTo(new Vector3(0, 0, -1)), 0);
  });
});

describe("orbiting", () => {
  test("keeps the distance to the center and the center's position in the view", () => {
    const pose = orbitPose(panPose(start, 0.2, 0.1), 0.7, -0.3);
    assertNear(pose.position.distanceTo(pose.center), start.position.distanceTo(start.center));
    assertNear(projected(pose, 1, pose.center).x, 0, 1e-6);
  });

  test("to the right moves near points to the right on the screen, downwards moves them down", () => {
    const front = start.position.clone().lerp(start.center, 0.5);
    assert.ok(projected(orbitPose(start, 0.1, 0), 1, front).x > 0);
    assert.ok(projected(orbitPose(start, 0, 0.1), 1, front).y < 0);
  });

  test("does not pass a pole or tilt the horizon, whatever the angles", () => {
    let pose = start;
    let random = 1;
    for (let step = 0; step < 2000; ++step) {
      random = (random * 48271) % 2147483647;
      pose = orbitPose(pose, (random % 7) - 3, ((random >> 8) % 9) - 4);
      const poleAngle = forward(pose).angleTo(pose.up);
      assert.ok(poleAngle > 0.01 && poleAngle < Math.PI - 0.01, `step ${step}: ${poleAngle}`);
      assertNear(new Vector3(1, 0, 0).applyQuaternion(pose.orientation).dot(pose.up), 0, 1e-6);
    }
  });

  test("stops at a pole and can turn back from it", () => {
    for (const down of [-4, 4]) {
      const atPole = orbitPose(start, 0, down);
      assert.ok(orbitPose(atPole, 0, -down / 8).position.distanceTo(atPole.position) > 0.1);
      assertNear(orbitPose(atPole, 0, down).position.distanceTo(atPole.position), 0, 1e-6);
    }
  });
});

describe("zooming and panning", () => {
  test("multiplies the distance within bounds, and works again after a bound has been reached", () => {
    assertNear(
      zoomPose(start, 0.5, sphere).position.distanceTo(start.center),
      0.5 * start.position.distanceTo(start.center),
    );
    let pose = start;
    for (let step = 0; step < 1000; ++step) pose = zoomPose(pose, 0.5, sphere);
    for (let step = 0; step < 1000; ++step) pose = zoomPose(pose, 2, sphere);
    const distance = pose.position.distanceTo(pose.center);
    assert.ok(Number.isFinite(distance) && distance > sphere.radius);
    assertNear(forward(pose).angleTo(pose.center.clone().sub(pose.position)), 0, 1e-6);
  });

  test("moves the center by the requested fraction of the view", () => {
    const pose = panPose(start, 0.25, -0.125);
    const { x, y } = projected(pose, 1, start.center);
    assertNear(x, 0.5, 1e-6);
    assertNear(y, -0.25, 1e-6);
  });
});

test("the depth range covers the scene only; for a camera in the scene it begins at the author's clearance", () => {
  const camera = new PerspectiveCamera();
  const nearOf = (pose: Pose, clearance?: number) => {
    applyPose(camera, pose, 1, sphere, clearance);
    return camera.near;
  };
  const inside = { ...start, position: sphere.center.clone() };
  assertNear(nearOf(start), start.position.distanceTo(sphere.center) - sphere.radius * 1.01);
  assertNear(nearOf(start, 0.02), nearOf(start));
  assertNear(nearOf(inside), sphere.radius * 1.01 * 1e-4);
  assertNear(nearOf(inside, 0.02), 0.02);
  assertNear(nearOf(inside, 100), sphere.radius * 1.01 * 1e-2);
});

test("a scene without extent has a valid camera", () => {
  const camera = new PerspectiveCamera();
  const point = new Box3(new Vector3(1, 1, 1), new Vector3(1, 1, 1)).getBoundingSphere(new Sphere());
  applyPose(camera, poseFraming(point), 1, point);
  assert.ok(camera.near > 0 && camera.far > camera.near);
  assert.ok(camera.projectionMatrix.elements.every(Number.isFinite));
});
