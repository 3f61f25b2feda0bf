import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Sphere, Vector3 } from "three";
import { forwardOf, framingDistance, poseFraming, orbitPose } from "./cameraPose.ts";
import type { Orbit } from "./orbit.ts";
import { orbitOf, poseOnOrbit, poseWith, poseWithin, unsetCamera } from "./orbit.ts";
import { AutoRotation } from "./autoRotation.ts";

const sphere = new Sphere(new Vector3(1, 2, 3), 2);
const start = poseFraming(sphere);
const degrees = (angle: number) => (angle * Math.PI) / 180;

function assertNear(actual: number, expected: number): void {
  assert.ok(Math.abs(actual - expected) < 1e-9 * Math.max(1, Math.abs(expected)), `${actual} is not ${expected}`);
}

function assertOrbit(actual: Orbit, expected: Partial<Orbit>): void {
  for (const [name, value] of Object.entries(expected)) assertNear(actual[name as keyof Orbit], value);
}

describe("an orbit", () => {
  test("is measured from +z towards +x, and down from above", () => {
    for (const [theta, phi, eye] of [
      [0, 90, [0, 0, 1]],
      [90, 90, [1, 0, 0]],
      [0, 45, [0, Math.SQRT1_2, Math.SQRT1_2]],
    ] as const) {
      const pose = poseOnOrbit(start, { theta: degrees(theta), phi: degrees(phi), radius: 5 });
      assertNear(
        pose.position
          .clone()
          .sub(sphere.center)
          .distanceTo(new Vector3(...eye).multiplyScalar(5)),
        0,
      );
      assertNear(forwardOf(pose).angleTo(sphere.center.clone().sub(pose.position)), 0);
    }
  });

  test("gives the pose that it was read from, also where up is not +y", () => {
    for (const up of [
      new Vector3(0, 1, 0),
      new Vector3(1, 1, 0).normalize(),
      new Vector3(0, 0, 1),
      new Vector3(0, -1, 0),
    ]) {
      for (const orbit of [
        { theta: 0.3, phi: 1.1, radius: 4 },
        { theta: -2.9, phi: 0.2, radius: 0.5 },
      ]) {
        assertOrbit(orbitOf(poseOnOrbit({ ...start, up }, orbit)), orbit);
      }
    }
  });

  test("turns with the camera: to the right is towards smaller theta", () => {
    const before = orbitOf(start);
    assertOrbit(orbitOf(orbitPose(start, 0.25, 0.1)), {
      theta: before.theta - 0.25,
      phi: before.phi - 0.1,
      radius: before.radius,
    });
  });

  test("is finite for an eye at the center", () => {
    assert.ok(Object.values(orbitOf({ ...start, position: start.center.clone() })).every(Number.isFinite));
  });
});

describe("the author's camera attributes", () => {
  test("change only what they set", () => {
    assert.equal(poseWith(start, unsetCamera, sphere).position, start.position);
    const orbit = { theta: undefined, phi: degrees(90), radius: undefined };
    const { theta, radius } = orbitOf(start);
    assertOrbit(orbitOf(poseWith(start, { ...unsetCamera, orbit }, sphere)), { theta, phi: degrees(90), radius });
    const wide = poseWith(start, { ...unsetCamera, fieldOfView: 1.2 }, sphere);
    assertNear(wide.fieldOfView, 1.2);
    assertNear(wide.position.distanceTo(start.position), 0);
  });

  test("may set the radius as a length, or as a multiple of the framing distance", () => {
    const radiusOf = (radius: { length: number } | { factor: number }) =>
      orbitOf(poseWith(start, { ...unsetCamera, fieldOfView: 1, orbit: { theta: 0, phi: 1, radius } }, sphere)).radius;
    assertNear(radiusOf({ length: 7 }), 7);
    assertNear(radiusOf({ factor: 1.5 }), 1.5 * framingDistance(sphere, 1));
  });

  test("may set the center, which the camera looks at", () => {
    const pose = poseWith(start, { ...unsetCamera, target: [5, 5, 5] }, sphere);
    assertNear(pose.center.distanceTo(new Vector3(5, 5, 5)), 0);
    assertNear(forwardOf(pose).angleTo(pose.center.clone().sub(pose.position)), 0);
  });

  test("bound user input", () => {
    const minOrbit = { theta: degrees(-30), phi: degrees(60), radius: { length: 3 } };
    const maxOrbit = { theta: degrees(30), phi: degrees(90), radius: { length: 6 } };
    const bounds = { ...unsetCamera, minOrbit, maxOrbit };
    const boundedFrom = (theta: number, phi: number, radius: number) =>
      orbitOf(poseWithin(poseOnOrbit(start, { theta: degrees(theta), phi: degrees(phi), radius }), bounds, sphere));
    assertOrbit(boundedFrom(10, 70, 5), { theta: degrees(10), phi: degrees(70), radius: 5 });
    assertOrbit(boundedFrom(100, 10, 1), { theta: degrees(30), phi: degrees(60), radius: 3 });
    assertOrbit(boundedFrom(-170, 170, 100), { theta: degrees(-30), phi: degrees(90), radius: 6 });
    const free = poseOnOrbit(start, { theta: 3, phi: 0.3, radius: 99 });
    assert.equal(poseWithin(free, unsetCamera, sphere), free);
  });

  test("bound an arc that crosses the back", () => {
    const arc = (theta: number) => ({ theta: degrees(theta), phi: undefined, radius: undefined });
    const bounds = { ...unsetCamera, minOrbit: arc(150), maxOrbit: arc(210) };
    const thetaOf = (theta: number) =>
      orbitOf(poseWithin(poseOnOrbit(start, { theta: degrees(theta), phi: 1, radius: 5 }), bounds, sphere)).theta;
    assertNear(thetaOf(-170), degrees(-170)); // is 190
    assertNear(thetaOf(-90), degrees(-150)); // 270 is nearest to 210
    assertNear(thetaOf(100), degrees(150));
  });
});

test("auto-rotation pauses after the start and after user input, and stops when it is stopped", (context) => {
  context.mock.timers.enable({ apis: ["setTimeout"] });
  let startCount = 0;
  const autoRotation = new AutoRotation(() => {
    startCount += 1;
  });
  autoRotation.delayMs = 1000;
  autoRotation.pause();
  assert.ok(autoRotation.isStopped);
  autoRotation.start(true);
  context.mock.timers.tick(999);
  assert.equal(autoRotation.isRotating, false);
  autoRotation.pause();
  context.mock.timers.tick(999);
  assert.equal(startCount, 0);
  context.mock.timers.tick(1);
  assert.ok(autoRotation.isRotating);
  assert.equal(startCount, 1);
  autoRotation.stop();
  autoRotation.pause();
  context.mock.timers.tick(5000);
  assert.ok(autoRotation.isStopped);
  autoRotation.start(false);
  assert.ok(autoRotation.isRotating);
});
