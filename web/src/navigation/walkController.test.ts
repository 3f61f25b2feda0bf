import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Quaternion, Vector3 } from "three";
import type { WorldBox } from "./boxWorld.testing.ts";
import { highestBelow, sampleGround } from "./boxWorld.testing.ts";
import type { Pose } from "./cameraPose.ts";
import { WalkController } from "./walkController.ts";

const avatar = { radius: 0.25, height: 1.6, step: 0.4 };
const speed = 2;
const frame = 1 / 60;

function box(min: WorldBox["min"], max: WorldBox["max"]): WorldBox {
  return { min, max };
}

const ground = box([-20, -1, -20], [20, 0, 20]);

function standing(x: number, y: number, z: number): Pose {
  const position = new Vector3(x, y, z);
  return {
    position,
    orientation: new Quaternion(),
    center: position.clone().add(new Vector3(0, 0, -4)),
    up: new Vector3(0, 1, 0),
    fieldOfView: 0.8,
  };
}

/** One frame: walks on the known ground, then adds ground samples if the controller requests them. */
function step(controller: WalkController, pose: Pose, boxes: readonly WorldBox[], direction?: Vector3): Pose {
  if (direction) controller.push(direction.clone().multiplyScalar(speed * frame), speed);
  const next = controller.walk(pose, frame);
  const camera = controller.depthCameraFor(next, avatar, speed);
  if (camera) controller.addGroundSamples(camera, sampleGround(camera, boxes));
  return next;
}

/** Walks in `direction` for `seconds`, then until the avatar rests; returns the eye position of every frame. */
function walk(start: Pose, direction: Vector3, seconds: number, boxes: readonly WorldBox[]): Vector3[] {
  const controller = new WalkController();
  const eyes: Vector3[] = [];
  let pose = start;
  for (let elapsed = 0; elapsed < seconds || controller.isMoving; elapsed += frame) {
    assert.ok(elapsed < seconds + 20, "the avatar does not stop");
    pose = step(controller, pose, boxes, elapsed < seconds ? direction : undefined);
    eyes.push(pose.position);
  }
  return eyes;
}

const last = (eyes: readonly Vector3[]): Vector3 => eyes.at(-1) ?? new Vector3();

function assertNear(actual: number, expected: number, tolerance = 0.02): void {
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);
}

const [ahead, right] = [new Vector3(0, 0, -1), new Vector3(1, 0, 0)];

describe("a walking avatar", () => {
  test("covers its distance at its height above the floor", () => {
    const { x, y, z } = last(walk(standing(0, 1.6, 0), ahead, 3, [ground]));
    assertNear(x, 0);
    assertNear(y, 1.6);
    assertNear(z, -6, 0.06);
  });

  test("comes down to the floor from a viewpoint above it, and up from one too low", () => {
    for (const height of [0.4, 3]) assertNear(last(walk(standing(0, height, 0), ahead, 0.1, [ground])).y, 1.6);
  });

  test("climbs stairs, smoothly, and stands on the landing", () => {
    const stairs = Array.from({ length: 12 }, (_, i) =>
      box([-1, 0, -1.3 - 0.3 * i], [1, 0.17 * (i + 1), -1 - 0.3 * i]),
    );
    const eyes = walk(standing(0, 1.6, 0), ahead, 4, [ground, ...stairs, box([-1, 0, -9], [1, 0.17 * 12, -4.6])]);
    assertNear(last(eyes).y, 1.6 + 0.17 * 12);
    eyes.slice(1).forEach((eye, i) => {
      assert.ok(Math.abs(eye.y - (eyes[i]?.y ?? 0)) < 0.06, `jumps at ${eye.z}`);
    });
  });

  test("does not climb what is higher than a step", () => {
    const { y, z } = last(walk(standing(0, 1.6, 0), ahead, 3, [ground, box([-5, 0, -9], [5, 0.5, -2])]));
    assertNear(y, 1.6);
    assertNear(z, -2 + avatar.radius, 0.1);
  });

  test("is stopped by a wall, and slides along it when it comes at an angle", () => {
    const wall = box([-15, 0, -9], [15, 4, -2]);
    assertNear(last(walk(standing(0, 1.6, 0), ahead, 3, [ground, wall])).z, -2 + avatar.radius);
    const aside = last(walk(standing(0, 1.6, 0), new Vector3(1, 0, -1).normalize(), 4, [ground, wall]));
    assertNear(aside.z, -2 + avatar.radius, 0.05);
    assert.ok(aside.x > 4, `slid only to ${aside.x}`);
  });

  test("goes through a doorway under its lintel, but not where the lintel is at eye level", () => {
    const doorway = (lintel: number) => [
      ground,
      box([-9, 0, -2.2], [-0.45, 4, -2]),
      box([0.45, 0, -2.2], [9, 4, -2]),
      box([-0.45, lintel, -2.2], [0.45, 4, -2]),
    ];
    assertNear(last(walk(standing(0, 1.6, 0), ahead, 2, doorway(2))).z, -4, 0.1);
    assertNear(last(walk(standing(0, 1.6, 0), ahead, 2, doorway(1.5))).z, -2 + avatar.radius);
  });

  test("falls from a ledge, with acceleration, onto what is below", () => {
    const eyes = walk(standing(0, 4.6, 0), ahead, 2, [ground, box([-5, 0, -1], [5, 3, 5])]);
    assertNear(last(eyes).y, 1.6);
    const falls = eyes
      .slice(1)
      .map((eye, i) => (eyes[i]?.y ?? 0) - eye.y)
      .filter((fall) => fall > 0)
      .slice(0, -1);
    assert.ok(falls.length > 20, `${falls.length} frames`);
    falls.slice(1).forEach((fall, i) => {
      assert.ok(fall > (falls[i] ?? 0));
    });
  });

  test("does not leave the floor", () => {
    const { y, z } = last(walk(standing(0, 1.6, 0), ahead, 3, [box([-5, -1, -2], [5, 0, 5])]));
    assertNear(y, 1.6);
    assertNear(z, -2 - avatar.radius, 0.15);
  });

  test("hovers where there has never been a floor, and comes down when it reaches one", () => {
    const platform = box([-5, -1, -9], [5, 0, -2]);
    const eyes = walk(standing(0, 2, 4), ahead, 4, [platform]);
    assert.ok(
      eyes.every(({ y, z }) => z < -1.7 || y === 2),
      "sinks where there is no floor",
    );
    assertNear(last(eyes).y, 1.6);
    assertNear(last(eyes).z, -4, 0.1);
  });

  test("can leave an obstacle that it starts in", () => {
    const pillar = box([-0.2, 0, -0.2], [0.1, 4, 0.2]);
    assertNear(last(walk(standing(0.2, 1.6, 0), right, 1, [ground, pillar])).x, 2.2, 0.1);
  });

  test("walks with any up direction", () => {
    const up = new Vector3(1, 2, -0.5).normalize();
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), up);
    const back = turn.clone().invert();
    const controller = new WalkController();
    let pose: Pose = { ...standing(0, 2.5, 0), position: new Vector3(0, 2.5, 0).applyQuaternion(turn), up };
    for (let count = 0; count < 120; ++count) {
      controller.push(
        ahead
          .clone()
          .multiplyScalar(speed * frame)
          .applyQuaternion(turn),
        speed,
      );
      pose = controller.walk(pose, frame);
      const camera = controller.depthCameraFor(pose, avatar, speed);
      if (camera === undefined) continue;
      const eye = camera.eye.clone().applyQuaternion(back);
      controller.addGroundSamples(camera, sampleGround({ ...camera, eye, orientation: new Quaternion() }, [ground]));
    }
    const { x, y, z } = pose.position.clone().applyQuaternion(back);
    assertNear(x, 0);
    assertNear(y, 1.6);
    assertNear(z, -4, 0.1);
  });
});

describe("ground samples", () => {
  test("are requested only while the avatar moves, and once each", () => {
    const controller = new WalkController();
    const pose = standing(0, 1.6, 0);
    assert.equal(controller.depthCameraFor(pose, avatar, speed), undefined);
    controller.push(ahead, speed);
    const camera = controller.depthCameraFor(pose, avatar, speed);
    assert.ok(camera);
    assert.equal(controller.depthCameraFor(pose, avatar, speed), camera);
    controller.stop();
    assert.equal(controller.depthCameraFor(pose, avatar, speed), undefined);
    controller.addGroundSamples(camera, sampleGround(camera, [ground])); // too late
    controller.push(ahead, speed);
    assert.equal(controller.walk(pose, frame), pose);
  });

  test("are waited for; movement requested meanwhile is carried out afterwards", () => {
    const controller = new WalkController();
    let pose = standing(0, 1.6, 0);
    for (let count = 0; count < 6; ++count) {
      controller.push(ahead.clone().multiplyScalar(speed * frame), speed);
      pose = controller.walk(pose, frame);
    }
    assertNear(pose.position.z, 0, 0);
    while (controller.isMoving) pose = step(controller, pose, [ground]);
    assertNear(pose.position.z, -6 * speed * frame, 1e-6);
  });

  test("do not matter to opposite moves between two frames: all of the rest is carried out", () => {
    const controller = new WalkController();
    let pose = standing(0, 1.6, 0);
    // Two fingers that move together: each pans, and the first one spreads them before the second one follows.
    for (const seconds of [0.08, 0.22, 0.08, -0.22, 0.08, 0.22, 0.08, -0.22]) {
      controller.push(ahead.clone().multiplyScalar(seconds * speed), speed);
    }
    while (controller.isMoving) pose = step(controller, pose, [ground]);
    assertNear(pose.position.z, -0.25 * speed, 1e-6);
  });

  test("bound the movement, however late the next samples come", () => {
    const controller = new WalkController();
    let pose = standing(0, 1.6, 0);
    controller.push(ahead, speed);
    const camera = controller.depthCameraFor(pose, avatar, speed);
    assert.ok(camera);
    controller.addGroundSamples(camera, sampleGround(camera, [ground]));
    for (let count = 0; count < 600; ++count) {
      controller.push(ahead.clone().multiplyScalar(speed * frame), speed);
      pose = controller.walk(pose, frame);
    }
    assert.ok(pose.position.z < -0.5 && pose.position.z >= -(camera.range - avatar.radius), `${pose.position.z}`);
  });
});

test("a long random walk among walls, stairs and holes never enters one of them", () => {
  let seed = 7;
  const random = (): number => {
    seed = (seed * 48271) % 2147483647;
    return seed / 2147483647;
  };
  const plates = [box([-6, -1, -6], [6, 0, 2]), box([-6, -1, 3], [6, 0, 6])]; // with a gap between them
  const obstacles = Array.from({ length: 25 }, () => {
    const [x, z] = [12 * random() - 6, 12 * random() - 6];
    return box([x, 0, z], [x + 0.2 + random(), [0.2, 0.35, 0.9, 3][Math.floor(4 * random())] ?? 1, z + 0.2 + random()]);
  });
  const boxes = [...plates, ...obstacles];
  const controller = new WalkController();
  let pose = standing(0, 2, 0);
  let direction = ahead;
  let distance = 0;
  for (let count = 0; count < 4000; ++count) {
    if (count % 40 === 0) direction = new Vector3(Math.sin(count * 1.7), 0, Math.cos(count * 1.7));
    const before = pose.position;
    pose = step(controller, pose, boxes, direction);
    const { x, y, z } = pose.position;
    distance += before.distanceTo(pose.position);
    const inside = boxes.find(({ min, max }) =>
      [x, y, z].every((value, axis) => value > (min[axis] ?? 0) && value < (max[axis] ?? 0)),
    );
    assert.equal(inside, undefined, `frame ${count}: at ${x} ${y} ${z} the eye is in a box`);
    const beside = [-0.3, 0, 0.3].flatMap((dx) => [-0.3, 0, 0.3].map((dz) => highestBelow(boxes, x + dx, y, z + dz)));
    assert.ok(Math.max(...beside) > -Infinity, `frame ${count}: at ${x} ${y} ${z} there is no floor`);
    assert.ok(
      y > highestBelow(boxes, x, y, z) + 0.9,
      `frame ${count}: at ${x} ${y} ${z} the eye is too near to the floor`,
    );
  }
  assert.ok(distance > 20, `the avatar has walked ${distance}`);
});
