import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Matrix4, Quaternion, Sphere, Vector3 } from "three";
import { nodeFields, type Values } from "../document/nodes.ts";
import { BindingStack } from "./bindingStack.ts";
import type { WorldBox } from "./boxWorld.testing.ts";
import { sampleGround } from "./boxWorld.testing.ts";
import type { Pose } from "./cameraPose.ts";
import type { ViewpointInstance } from "../scene/instances.ts";
import { forwardOf, poseFraming, poseOfViewpoint, orbitPose } from "./cameraPose.ts";
import { interpolatePose } from "./cameraTransition.ts";
import { navigationTypesOf } from "./navigationType.ts";
import { CameraController } from "./cameraController.ts";
import { lateWalkController } from "./lateWalking.ts";
import { WalkController } from "./walkController.ts";
import { turnPose, noMovement, movePose, applyMovement } from "./firstPerson.ts";

lateWalkController.add(() => new WalkController());

const defaultsOf = (fields: Record<string, { defaultValue: unknown }>) =>
  Object.fromEntries(Object.entries(fields).map(([name, { defaultValue }]) => [name, defaultValue]));
const navigationInfo = defaultsOf(nodeFields.NavigationInfo) as Values<typeof nodeFields.NavigationInfo>;
const viewpointFields = defaultsOf(nodeFields.Viewpoint) as Values<typeof nodeFields.Viewpoint>;
const sphere = new Sphere(new Vector3(0, 0, 0), 3);

function viewpoint(description: string, fields: Partial<typeof viewpointFields> = {}): ViewpointInstance {
  const element = { localName: description, children: [], getAttribute: () => null, getAttributeNames: () => [] };
  return { element, viewpoint: { ...viewpointFields, description, ...fields }, sceneFromViewpoint: new Matrix4() };
}

function assertNear(actual: Vector3, expected: Vector3 | [number, number, number], tolerance = 1e-9): void {
  const expectedVector = Array.isArray(expected) ? new Vector3(...expected) : expected;
  assert.ok(
    actual.distanceTo(expectedVector) <= tolerance,
    `${actual.toArray().join(" ")} is not ${expectedVector.toArray().join(" ")}`,
  );
}

function assertPose(actual: Pose, expected: Pose, tolerance = 1e-9): void {
  assertNear(actual.position, expected.position, tolerance);
  assertNear(forwardOf(actual), forwardOf(expected), tolerance);
}

describe("the binding stack", () => {
  const stackOf = (nodes: string[], bindRequested: string[] = []) => {
    const stack = new BindingStack<string>();
    stack.setNodes(nodes, (node) => bindRequested.includes(node));
    return stack;
  };

  test("binds the first node, or the last one that requests to be bound", () => {
    assert.equal(stackOf([]).bound, undefined);
    assert.equal(stackOf(["a", "b", "c"]).bound, "a");
    assert.equal(stackOf(["a", "b", "c"], ["c", "b"]).bound, "c");
  });

  test("binds the node below when the top is unbound or removed from the scene", () => {
    const stack = stackOf(["a", "b", "c"]);
    stack.bind("c");
    stack.bind("b");
    stack.unbind("b");
    assert.equal(stack.bound, "c");
    stack.bind("b");
    stack.setNodes(["a", "c"], () => false);
    assert.equal(stack.bound, "c");
    stack.setNodes([], () => false);
    assert.equal(stack.bound, undefined);
  });

  test("is never empty while there are nodes", () => {
    const stack = stackOf(["a", "b"]);
    stack.unbind("a");
    assert.equal(stack.bound, "b");
    const only = stackOf(["a"]);
    only.unbind("a");
    assert.equal(only.bound, "a");
  });

  test("binds a new node that requests to be bound, but an old one only by `bind`", () => {
    const stack = stackOf(["a", "b"]);
    stack.setNodes(["a", "b"], () => true);
    assert.equal(stack.bound, "a");
    stack.setNodes(["a", "b", "c"], () => true);
    assert.equal(stack.bound, "c");
  });
});

describe("the allowed navigation types", () => {
  for (const [names, first, allowed] of [
    [["EXAMINE", "ANY"], "examine", ["examine", "walk", "fly"]],
    [["WALK"], "walk", ["walk"]],
    [["fly", "walk"], "fly", ["fly", "walk"]],
    [["NONE"], "none", ["none"]],
    [["NONE", "ANY"], "none", ["none", "examine", "walk", "fly"]],
    [["TURNTABLE"], "examine", ["examine"]],
    [["SWIM"], "examine", ["examine", "walk", "fly"]],
    [[], "examine", ["examine", "walk", "fly"]],
  ] as const) {
    test(`of "${names.join(" ")}" are ${allowed.join(", ")}, and the initial one is ${first}`, () => {
      const types = navigationTypesOf(names);
      assert.deepEqual([types.first, types.allowed], [first, allowed]);
    });
  }
});

describe("a camera transition", () => {
  const from = poseFraming(sphere);

  test("begins and ends exactly at the two poses", () => {
    const to = orbitPose(from, 2, 0.3);
    assert.equal(interpolatePose(from, to, 0), from);
    assert.equal(interpolatePose(from, to, 1), to);
    assertPose(interpolatePose(from, to, 1e-9), from, 1e-6);
    assertPose(interpolatePose(from, to, 1 - 1e-9), to, 1e-6);
  });

  test("to the other side goes around the scene and keeps its distance", () => {
    const to = orbitPose(from, Math.PI * 0.95, 0);
    const distance = from.position.distanceTo(from.center);
    for (let t = 0; t <= 1; t += 0.05) {
      const pose = interpolatePose(from, to, t);
      assert.ok(Math.abs(pose.position.distanceTo(pose.center) - distance) < 1e-6 * distance);
      assert.ok(forwardOf(pose).angleTo(pose.center.clone().sub(pose.position)) < 1e-5);
    }
  });

  test("stays finite where the eye is at the center", () => {
    const inside: Pose = { ...from, center: from.position.clone() };
    for (const [a, b] of [
      [from, inside],
      [inside, from],
      [inside, inside],
    ] as const) {
      const { position, orientation } = interpolatePose(a, b, 0.5);
      assert.ok([...position.toArray(), ...orientation.toArray()].every(Number.isFinite));
    }
  });
});

describe("walking and flying", () => {
  const upright: Pose = {
    position: new Vector3(0, 1.6, 0),
    orientation: new Quaternion(),
    center: new Vector3(0, 1.6, -4),
    up: new Vector3(0, 1, 0),
    fieldOfView: 0.8,
  };

  test("walking stays on its level wherever the camera looks, flying follows the view direction", () => {
    const lookingDown = turnPose(upright, 0, -0.8);
    assertNear(movePose(lookingDown, 2, 0, 0, true).position, [0, 1.6, -2]);
    assertNear(movePose(lookingDown, 2, 0, 0, false).position, [0, 1.6 - 2 * Math.sin(0.8), -2 * Math.cos(0.8)]);
    assertNear(movePose(lookingDown, 0, 3, 1, true).position, [3, 2.6, 0]);
  });

  test("a camera that looks straight down still walks ahead", () => {
    const { position } = movePose(turnPose(upright, 0, -10), 2, 0, 0, true);
    assertNear(position, [0, 1.6, -2], 1e-6);
  });

  test("turning rotates the camera in place, at most up to the zenith", () => {
    const pose = turnPose(upright, Math.PI / 2, 0);
    assertNear(forwardOf(pose), [1, 0, 0]);
    assertNear(pose.position, upright.position);
    assertNear(pose.center, [4, 1.6, 0]);
    assert.ok(forwardOf(turnPose(upright, 0, 9)).y < 1);
    assert.ok(forwardOf(turnPose(upright, 0, 9)).y > 0.99);
  });

  test("covers speed times time, however many frames it takes", () => {
    const motion = { ...noMovement, forward: 1 };
    let pose = upright;
    for (let frame = 0; frame < 60; ++frame) pose = applyMovement(pose, motion, 1 / 60, 2.5, true);
    assertNear(pose.position, [0, 1.6, -2.5], 1e-9);
  });
});

describe("the controller", () => {
  const [front, side] = [
    viewpoint("front"),
    viewpoint("side", { position: [10, 0, 0], orientation: [0, 1, 0, Math.PI / 2] }),
  ];
  const [frontPose, sidePose] = [poseOfViewpoint(front), poseOfViewpoint(side)];

  function controllerFor(changes: Partial<typeof navigationInfo> = {}, viewpoints = [front, side]) {
    let frameRequests = 0;
    const controller = new CameraController(
      () => {
        frameRequests += 1;
      },
      () => undefined,
    );
    controller.setScene({ sphere, viewpoints, navigation: { ...navigationInfo, ...changes } });
    return { controller, frameRequests: () => frameRequests };
  }

  test("starts at the first viewpoint, without a transition", () => {
    const { controller } = controllerFor();
    assert.equal(controller.bound, front.element);
    assert.equal(controller.isMoving, false);
    assertPose(controller.advance(0), frontPose);
  });

  test("without viewpoints shows the bounds of what moves, and all of the scene beside them", () => {
    const { controller } = controllerFor({}, []);
    assertPose(controller.pose, poseFraming(sphere));
    const motion = new Sphere(sphere.center.clone().add(new Vector3(sphere.radius, 0, 0)), 4 * sphere.radius);
    controller.setMotion(motion);
    assertPose(controller.pose, poseFraming(motion));
    const beside = new Sphere(motion.center.clone().add(new Vector3(0, 9 * sphere.radius, 0)), sphere.radius);
    controller.setMotion(beside);
    assertPose(controller.pose, poseFraming(beside.clone().union(sphere)));
    controller.setMotion(undefined);
    assertPose(controller.pose, poseFraming(sphere));
  });

  test("moves to a bound viewpoint within the document's transition time", () => {
    const { controller } = controllerFor({ transitionTime: 2 });
    controller.bind(side.element);
    assertPose(controller.advance(500), frontPose);
    assert.ok(controller.isMoving);
    const { position } = controller.advance(1500);
    assert.ok(position.distanceTo(frontPose.position) > 1 && position.distanceTo(sidePose.position) > 1);
    assertPose(controller.advance(2501), sidePose);
    assert.equal(controller.isMoving, false);
  });

  test("moves to a bound viewpoint at once where the document requires it or the user prefers reduced motion", () => {
    const { controller: teleporting } = controllerFor({ transitionType: ["TELEPORT"] });
    const { controller: reduced } = controllerFor();
    reduced.isInstant = true;
    for (const controller of [teleporting, reduced]) {
      controller.bind(side.element);
      assertPose(controller.advance(0), sidePose);
      assert.equal(controller.isMoving, false);
    }
  });

  test("returns to a viewpoint that is bound again, and to the previous one after an unbind", () => {
    const { controller } = controllerFor({ transitionTime: 0 });
    controller.bind(side.element);
    controller.turn(0.4, 0.1);
    controller.bind(side.element);
    assertPose(controller.advance(0), sidePose);
    controller.bind(side.element, false);
    assertPose(controller.advance(0), frontPose);
  });

  test("follows the bound viewpoint when it changes, but no other one", () => {
    const { controller } = controllerFor();
    controller.turn(0.3, 0);
    const { pose } = controller;
    const movedViewpoint = viewpoint("side", { position: [0, 20, 0] });
    controller.setScene({
      sphere,
      viewpoints: [front, { ...movedViewpoint, element: side.element }],
      navigation: navigationInfo,
    });
    assertPose(controller.pose, pose);
    controller.setScene({
      sphere,
      viewpoints: [{ ...movedViewpoint, element: front.element }],
      navigation: navigationInfo,
    });
    assertNear(controller.pose.position, [0, 20, 0]);
  });

  test("frames a growing scene without viewpoint until the user moves the camera", () => {
    const { controller } = controllerFor({}, []);
    const larger = new Sphere(new Vector3(1, 0, 0), 9);
    controller.setScene({ sphere: larger, viewpoints: [], navigation: navigationInfo });
    assertPose(controller.pose, poseFraming(larger));
    controller.zoom(0.5);
    const { pose } = controller;
    controller.setScene({ sphere, viewpoints: [], navigation: navigationInfo });
    assertPose(controller.pose, pose);
    controller.isInstant = true;
    controller.reset();
    assertPose(controller.pose, poseFraming(sphere));
  });

  test("does not move in NONE, but still binds viewpoints", () => {
    const { controller } = controllerFor({ type: ["NONE"], transitionTime: 0 });
    for (const act of [
      () => {
        controller.turn(1, 1);
      },
      () => {
        controller.zoom(2);
      },
      () => {
        controller.pan(1, 1);
      },
      () => {
        controller.showAll();
      },
      () => {
        controller.reset();
      },
      () => {
        controller.type = "fly";
      },
      () => {
        controller.move({ ...noMovement, forward: 1 });
      },
    ]) {
      act();
      assertPose(controller.advance(0), frontPose);
    }
    controller.bind(side.element);
    assertPose(controller.advance(0), sidePose);
  });

  /** Advances by a frame, then adds ground samples if the controller requests them. */
  function advance(controller: CameraController, ms: number, boxes: readonly WorldBox[]): void {
    controller.advance(ms);
    const { depthCamera } = controller;
    if (depthCamera) controller.addGroundSamples(depthCamera, sampleGround(depthCamera, boxes));
  }

  test("walks by zooming and panning too, and stops when a viewpoint is bound", () => {
    const floor = { min: [-20, -4, -20], max: [20, -3, 20] } as const;
    const { controller } = controllerFor({ type: ["WALK"], speed: 2, transitionTime: 0 });
    controller.zoom(Math.exp(-0.1));
    controller.pan(0.1, -0.05);
    for (let ms = 0; ms < 2000; ms += 20) advance(controller, ms, [floor]);
    assertNear(controller.pose.position, [-0.2, -1.4, 9.7], 1e-3);
    assert.equal(controller.isMoving, false);
    assert.equal(controller.depthCamera, undefined);
    controller.zoom(Math.exp(-0.2));
    controller.bind(side.element);
    for (let ms = 2000; ms < 2200; ms += 20) advance(controller, ms, [floor]);
    assertPose(controller.pose, sidePose);
  });

  test("walks while a movement is set, at the document's speed", () => {
    const { controller } = controllerFor({ type: ["WALK"], speed: 2 });
    controller.advance(0);
    controller.move({ ...noMovement, forward: 1 });
    controller.advance(1000); // the first frame only starts the clock
    for (let ms = 1050; ms <= 2000; ms += 50) advance(controller, ms, []);
    assertNear(controller.pose.position, [0, 0, 8], 1e-6);
    controller.move(noMovement);
    assert.equal(controller.isMoving, false);
    controller.advance(9000);
    assertNear(controller.pose.position, [0, 0, 8], 1e-6);
  });

  test("requests frames only when something has changed", () => {
    const { controller, frameRequests } = controllerFor();
    const before = frameRequests();
    controller.type = "examine";
    controller.move({ ...noMovement, forward: 1 }); // EXAMINE ignores movement
    controller.bind(viewpoint("unknown").element);
    assert.equal(frameRequests(), before);
    controller.turn(0.1, 0);
    assert.equal(frameRequests(), before + 1);
    assert.equal(controller.source, "user-interaction");
  });
});
