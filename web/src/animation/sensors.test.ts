import assert from "node:assert/strict";
import { test } from "node:test";
import { play, startOfTests, type TestScene } from "./animation.testing.ts";
import { PointingSensor } from "./pointingSensors.ts";
import type { Point, Ray } from "./rays.ts";
import { ViewSensor, type LocalView } from "./viewSensors.ts";

/** The ray of an eye at z = 10 through a point. */
function rayTo([x, y, z]: Point, origin: Point = [0, 0, 10]): Ray {
  return { origin, direction: [x - origin[0], y - origin[1], z - origin[2]] };
}

/** Presses at the first point and drags through the others. */
function dragOver(scene: TestScene, points: readonly Point[], origin?: Point): void {
  const sensor = scene.player.nodes.get(scene.root.named("it"))?.behaviour;
  assert.ok(sensor instanceof PointingSensor);
  const [first = [0, 0, 0], ...others] = points;
  scene.player.run(() => {
    sensor.press({ point: first, normal: [0, 0, 1] }, rayTo(first, origin));
  });
  for (const point of others)
    scene.player.run(() => {
      sensor.drag(rayTo(point, origin));
    });
  scene.player.run((time) => {
    sensor.release(true, time);
  });
}

/** The numbers of the last event of a field. */
function lastOf({ events }: TestScene, field: string): number[] {
  const event = events.findLast((candidate) => candidate.startsWith(`it.${field} `)) ?? "";
  return event.slice(event.indexOf(" ")).split(",").map(Number);
}

function assertNear(actual: readonly number[], expected: readonly number[]): void {
  assert.equal(actual.length, expected.length);
  actual.forEach((value, i) => {
    assert.ok(Math.abs(value - (expected[i] ?? NaN)) < 2e-5, `${actual.join(" ")} is not ${expected.join(" ")}`);
  });
}

test("a TouchSensor sends where the pointer is, and the time of a touch that ends on it", () => {
  const scene = play(`<TouchSensor DEF="it"/>`);
  const sensor = scene.player.nodes.get(scene.root.named("it"))?.behaviour as PointingSensor;
  scene.player.run(() => {
    sensor.over({ point: [1, 2, 3], normal: [0, 0, 1] });
  });
  scene.at(4);
  dragOver(scene, [[1, 2, 3]]);
  scene.player.run(() => {
    sensor.over(undefined);
  });
  assert.deepEqual(scene.events, [
    "it.isOver true",
    "it.hitPoint_changed 1,2,3",
    "it.hitNormal_changed 0,0,1",
    "it.isActive true",
    "it.isActive false",
    `it.touchTime ${startOfTests + 4}`,
    "it.isOver false",
  ]);
});

test("a PlaneSensor follows the pointer in the plane that was pressed, and goes on from there", () => {
  const scene = play(`<PlaneSensor DEF="it"/>`);
  dragOver(scene, [
    [0, 0, 1],
    [2, 1, 1],
  ]);
  assertNear(lastOf(scene, "translation_changed"), [2, 1, 0]);
  assertNear(lastOf(scene, "trackPoint_changed"), [2, 1, 1]);
  assertNear(lastOf(scene, "offset"), [2, 1, 0]);
  dragOver(scene, [
    [2, 1, 1],
    [2, 4, 1],
  ]);
  assertNear(lastOf(scene, "translation_changed"), [2, 4, 0]);
});

test("limits of a PlaneSensor hold where the minimum is not above the maximum", () => {
  const scene = play(`<PlaneSensor DEF="it" minPosition="0 0" maxPosition="1 0"/>`);
  dragOver(scene, [
    [0, 0, 0],
    [5, 5, 0],
  ]);
  assertNear(lastOf(scene, "translation_changed"), [1, 0, 0]);
});

test("axisRotation turns a PlaneSensor's plane", () => {
  const scene = play(`<PlaneSensor DEF="it" axisRotation="1 0 0 -1.5707963267948966"/>`);
  // The plane across y: a ray from above moves it in x and z.
  dragOver(
    scene,
    [
      [0, 0, 0],
      [1, 0, 2],
    ],
    [0, 10, 0],
  );
  assertNear(lastOf(scene, "translation_changed"), [1, 0, 2]);
});

test("a SphereSensor turns as a ball", () => {
  const scene = play(`<SphereSensor DEF="it"/>`);
  const eye: Point = [0, 0, 1e5]; // rays are parallel
  dragOver(
    scene,
    [
      [0, 0, 1],
      [Math.SQRT1_2, 0, Math.SQRT1_2],
    ],
    eye,
  );
  assertNear(lastOf(scene, "rotation_changed"), [0, 1, 0, Math.PI / 4]);
  assertNear(lastOf(scene, "offset"), [0, 1, 0, Math.PI / 4]);
});

test("a CylinderSensor turns about its axis, as a disk where the viewer looks along it", () => {
  const side = play(`<CylinderSensor DEF="it"/>`);
  dragOver(
    side,
    [
      [0, 0, 1],
      [Math.SQRT1_2, 0.5, Math.SQRT1_2],
    ],
    [0, 0, 1e5],
  );
  assertNear(lastOf(side, "rotation_changed"), [0, 1, 0, Math.PI / 4]);
  const top = play(`<CylinderSensor DEF="it" maxAngle="1"/>`);
  dragOver(
    top,
    [
      [0, 1, 1],
      [1, 1, 0],
    ],
    [0, 1e5, 0],
  );
  assertNear(lastOf(top, "rotation_changed"), [0, 1, 0, 1]); // a quarter turn, limited to 1
});

test("a CylinderSensor counts turns", () => {
  const scene = play(`<CylinderSensor DEF="it"/>`);
  const points = Array.from({ length: 7 }, (_, i): Point => [Math.sin(i), 0, Math.cos(i)]);
  dragOver(scene, points, [0, 1e5, 0]);
  assertNear(lastOf(scene, "rotation_changed"), [0, 1, 0, 6]);
});

/** The view of an eye that looks along -z, in a square frustum of 90 degrees, of depths from 0.1 to 100. */
function viewFrom(position: [number, number, number]): LocalView {
  const [x, y, z] = position;
  // prettier-ignore
  return { position, orientation: [0, 0, 0, 1], centerOfRotation: [0, 0, 0],
    clipFromLocal: [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, -1.002, -1,  -x, -y, 1.002 * z - 0.2002, z] };
}

function followView(scene: TestScene, position: [number, number, number]): void {
  const sensor = scene.player.nodes.get(scene.root.named("it"))?.behaviour;
  assert.ok(sensor instanceof ViewSensor);
  scene.player.run((time) => {
    sensor.follow(viewFrom(position), time);
  });
}

test("a ProximitySensor sends the viewer's pose while the viewer is in its box", () => {
  const scene = play(`<ProximitySensor DEF="it" size="4 4 4" center="1 0 0"/>`);
  followView(scene, [5, 0, 0]);
  assert.deepEqual(scene.events, []);
  scene.at(2);
  followView(scene, [3, 0, 1]);
  followView(scene, [3, 0, 1]);
  followView(scene, [3.5, 0, 1]);
  assert.deepEqual(scene.events, [
    "it.isActive true",
    `it.enterTime ${startOfTests + 2}`,
    "it.position_changed 3,0,1",
    "it.orientation_changed 0,0,1,0",
    "it.centerOfRotation_changed 0,0,0",
    "it.isActive false",
    `it.exitTime ${startOfTests + 2}`,
  ]);
});

test("a VisibilitySensor knows whether its box may be in the view", () => {
  const scene = play(`<VisibilitySensor DEF="it" size="1 1 1"/>`);
  followView(scene, [0, 0, 5]);
  assert.equal(scene.events[0], "it.isActive true");
  followView(scene, [0, 0, -5]);
  assert.equal(scene.events[2], "it.isActive false");
  followView(scene, [20, 0, 5]);
  assert.equal(scene.events.length, 4);
});

test("a VisibilitySensor whose box is farther away than all shapes, or around the viewer, is active", () => {
  for (const fields of ['center="0 0 -5000" size="9 9 9"', 'size="20 20 20"']) {
    const scene = play(`<VisibilitySensor DEF="it" ${fields}/>`);
    followView(scene, [0, 0, 5]);
    assert.equal(scene.events[0], "it.isActive true", fields);
  }
});

test("a sensor without size, or switched off, notices nothing", () => {
  for (const fields of ["", `size="9 9 9" enabled="false"`]) {
    const scene = play(`<ProximitySensor DEF="it" ${fields}/>`);
    followView(scene, [0, 0, 0]);
    assert.deepEqual(scene.events, []);
  }
});
