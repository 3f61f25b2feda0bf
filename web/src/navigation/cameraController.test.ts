import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Matrix4, Quaternion, Sphere, Vector3 } from "three";
import { nodeFields, type Values } from "../document/nodes.ts";
import { BindingStack } from "./bindingStack.ts";
import type { WorldBox } from "./boxWorld.testing.ts";
import { sampleGround } from "./boxWorld.testing.ts";
import type { Pose } from "./cameraPose.ts";
import type { ViewpointInstance } from "../scene/instances.ts";
import { forwardOf, poseFraming, poseOfViewpoint, orbited } from "./cameraPose.ts";
import { interpolatePose } from "./cameraTransition.ts";
import { navigationTypesOf } from "./navigationType.ts";
import { CameraController } from "./cameraController.ts";
import { turnEye, noMovement, moveEye, applyMovement } from "./firstPerson.ts";

const defaultsOf = (fields: Record<string, { defaultValue: unknown }>) =>
  Object.fromEntries(Object.entries(fields).map(([name, { defaultValue }]) => [name, defaultValue]));
const navigationInfo = defaultsOf(nodeFields.NavigationInfo) as Values<typeof nodeFields.NavigationInfo>;
const viewpointFields = defaultsOf(nodeFields.Viewpoint) as Values<typeof nodeFields.Viewpoint>;
const sphere = new Sphere(new Vector3(0, 0, 0), 3);

function viewpoint(description: string, fields: Partial<typeof viewpointFields> = {}): ViewpointInstance {
  const element = { localName: description, children: [], getAttribute: () => null, getAttributeNames: () => [] };
  return { element, viewpoint: { ...viewpointFields, description, ...fields }, sceneFromViewpoint: new Matrix4() };
}

function near(actual: Vector3, expected: Vector3 | [number, number, number], tolerance = 1e-9): void {
  const wanted = Array.isArray(expected) ? new Vector3(...expected) : expected;
  assert.ok(
    actual.distanceTo(wanted) <= tolerance,
    `${actual.toArray().join(" ")} is not ${wanted.toArray().join(" ")}`,
  );
}

function samePose(actual: Pose, expected: Pose, tolerance = 1e-9): void {
  near(actual.position, expected.position, tolerance);
  near(forwardOf(actual), forwardOf(expected), tolerance);
}

describe("the binding stack", () => {
  const stackOf = (nodes: string[], wanted: string[] = []) => {
    const stack = new BindingStack<string>();
    stack.setNodes(nodes, (node) => wanted.includes(node));
    return stack;
  };

  test("binds the first node, or the last of those that ask to be bound", () => {
    assert.equal(stackOf([]).bound, undefined);
    assert.equal(stackOf(["a", "b", "c"]).bound, "a");
    assert.equal(stackOf(["a", "b", "c"], ["c", "b"]).bound, "c");
  });

  test("returns to the one below when the top is unbound or leaves the scene", () => {
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

  test("binds a new node that asks to be bound, but an old one only by bind", () => {
    const stack = stackOf(["a", "b"]);
    stack.setNodes(["a", "b"], () => true);
    assert.equal(stack.bound, "a");
    stack.setNodes(["a", "b", "c"], () => true);
    assert.equal(stack.bound, "c");
  });
});

describe("the types of navigation", () => {
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
    test(`${names.join(" ")}: ${first} of ${allowed.join(", ")}`, () => {
      const types = navigationTypesOf(names);
      assert.deepEqual([types.first, types.allowed], [first, allowed]);
    });
  }
});

describe("a camera transition", () => {
  const from = poseFraming(sphere);

  test("begins and ends exactly at the two poses", () => {
    const to = orbited(from, 2, 0.3);
    assert.equal(interpolatePose(from, to, 0), from);
    assert.equal(interpolatePose(from, to, 1), to);
    samePose(interpolatePose(from, to, 1e-9), from, 1e-6);
    samePose(interpolatePose(from, to, 1 - 1e-9), to, 1e-6);
  });

  test("to the other side goes around the scene and keeps its distance", () => {
    const to = orbited(from, Math.PI * 0.95, 0);
    const distance = from.position.distanceTo(from.center);
    for (let share = 0; share <= 1; share += 0.05) {
      const pose = interpolatePose(from, to, share);
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
    const lookingDown = turnEye(upright, 0, -0.8);
    near(moveEye(lookingDown, 2, 0, 0, true).position, [0, 1.6, -2]);
    near(moveEye(lookingDown, 2, 0, 0, false).position, [0, 1.6 - 2 * Math.sin(0.8), -2 * Math.cos(0.8)]);
    near(moveEye(lookingDown, 0, 3, 1, true).position, [3, 2.6, 0]);
  });

  test("a camera that looks straight down still walks ahead", () => {
    const { position } = moveEye(turnEye(upright, 0, -10), 2, 0, 0, true);
    near(position, [0, 1.6, -2], 1e-6);
  });

  test("turning rotates the camera in place, at most up to the zenith", () => {
    const pose = turnEye(upright, Math.PI / 2, 0);
    near(forwardOf(pose), [1, 0, 0]);
    near(pose.position, upright.position);
    near(pose.center, [4, 1.6, 0]);
    assert.ok(forwardOf(turnEye(upright, 0, 9)).y < 1);
    assert.ok(forwardOf(turnEye(upright, 0, 9)).y > 0.99);
  });

  test("covers speed times time, however many frames it takes", () => {
    const motion = { ...noMovement, forward: 1 };
    let pose = upright;
    for (let frame = 0; frame < 60; ++frame) pose = applyMovement(pose, motion, 1 / 60, 2.5, true);
    near(pose.position, [0, 1.6, -2.5], 1e-9);
  });
});

describe("the controller", () => {
  const [front, side] = [
    viewpoint("front"),
    viewpoint("side", { position: [10, 0, 0], orientation: [0, 1, 0, Math.PI / 2] }),
  ];
  const [frontPose, sidePose] = [poseOfViewpoint(front), poseOfViewpoint(side)];

  function navigating(changes: Partial<typeof navigationInfo> = {}, viewpoints = [front, side]) {
    let calls = 0;
    const controller = new CameraController(
      () => {
        calls += 1;
      },
      () => undefined,
    );
    controller.setScene({ sphere, viewpoints, navigation: { ...navigationInfo, ...changes } });
    return { controller, calls: () => calls };
  }

  test("starts at the first viewpoint, without a transition", () => {
    const { controller } = navigating();
    assert.equal(controller.bound, front.element);
    assert.equal(controller.isMoving, false);
    samePose(controller.advance(0), frontPose);
  });

  test("moves to a bound viewpoint within the document's transition time", () => {
    const { controller } = navigating({ transitionTime: 2 });
    controller.bind(side.element);
    samePose(controller.advance(500), frontPose);
    assert.ok(controller.isMoving);
    const { position } = controller.advance(1500);
    assert.ok(position.distanceTo(frontPose.position) > 1 && position.distanceTo(sidePose.position) > 1);
    samePose(controller.advance(2501), sidePose);
    assert.equal(controller.isMoving, false);
  });

  test("moves there at once where the document or the user asks for no motion", () => {
    const { controller: teleporting } = navigating({ transitionType: ["TELEPORT"] });
    const { controller: reduced } = navigating();
    reduced.isInstant = true;
    for (const controller of [teleporting, reduced]) {
      controller.bind(side.element);
      samePose(controller.advance(0), sidePose);
      assert.equal(controller.isMoving, false);
    }
  });

  test("returns to a viewpoint when it is bound once more, and to the one before when it is unbound", () => {
    const { controller } = navigating({ transitionTime: 0 });
    controller.bind(side.element);
    controller.turn(0.4, 0.1);
    controller.bind(side.element);
    samePose(controller.advance(0), sidePose);
    controller.bind(side.element, false);
    samePose(controller.advance(0), frontPose);
  });

  test("follows the bound viewpoint when it changes, but no other one", () => {
    const { controller } = navigating();
    controller.turn(0.3, 0);
    const { pose } = controller;
    const moved = viewpoint("side", { position: [0, 20, 0] });
    controller.setScene({
      sphere,
      viewpoints: [front, { ...moved, element: side.element }],
      navigation: navigationInfo,
    });
    samePose(controller.pose, pose);
    controller.setScene({ sphere, viewpoints: [{ ...moved, element: front.element }], navigation: navigationInfo });
    near(controller.pose.position, [0, 20, 0]);
  });

  test("frames a growing scene without viewpoint until the user moves the camera", () => {
    const { controller } = navigating({}, []);
    const larger = new Sphere(new Vector3(1, 0, 0), 9);
    controller.setScene({ sphere: larger, viewpoints: [], navigation: navigationInfo });
    samePose(controller.pose, poseFraming(larger));
    controller.zoom(0.5);
    const { pose } = controller;
    controller.setScene({ sphere, viewpoints: [], navigation: navigationInfo });
    samePose(controller.pose, pose);
    controller.isInstant = true;
    controller.reset();
    samePose(controller.pose, poseFraming(sphere));
  });

  test("does not move in NONE, but still binds viewpoints", () => {
    const { controller } = navigating({ type: ["NONE"], transitionTime: 0 });
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
      samePose(controller.advance(0), frontPose);
    }
    controller.bind(side.element);
    samePose(controller.advance(0), sidePose);
  });

  /** A frame, after which it is told what it asks for. */
  function advance(controller: CameraController, ms: number, boxes: readonly WorldBox[]): void {
    controller.advance(ms);
    const { depthCamera } = controller;
    if (depthCamera) controller.addGroundSamples(depthCamera, sampleGround(depthCamera, boxes));
  }

  test("walks by wheel and by two fingers too, and stops when a viewpoint is bound", () => {
    const floor = { min: [-20, -4, -20], max: [20, -3, 20] } as const;
    const { controller } = navigating({ type: ["WALK"], speed: 2, transitionTime: 0 });
    controller.zoom(Math.exp(-0.1));
    controller.pan(0.1, -0.05);
    for (let ms = 0; ms < 2000; ms += 20) advance(controller, ms, [floor]);
    near(controller.pose.position, [-0.2, -1.4, 9.7], 1e-3);
    assert.equal(controller.isMoving, false);
    assert.equal(controller.depthCamera, undefined);
    controller.zoom(Math.exp(-0.2));
    controller.bind(side.element);
    for (let ms = 2000; ms < 2200; ms += 20) advance(controller, ms, [floor]);
    samePose(controller.pose, sidePose);
  });

  test("walks while a key is held, at the document's speed", () => {
    const { controller } = navigating({ type: ["WALK"], speed: 2 });
    controller.advance(0);
    controller.move({ ...noMovement, forward: 1 });
    controller.advance(1000); // the first frame only starts the clock
    for (let ms = 1050; ms <= 2000; ms += 50) advance(controller, ms, []);
    near(controller.pose.position, [0, 0, 8], 1e-6);
    controller.move(noMovement);
    assert.equal(controller.isMoving, false);
    controller.advance(9000);
    near(controller.pose.position, [0, 0, 8], 1e-6);
  });

  test("asks for frames only when something has changed", () => {
    const { controller, calls } = navigating();
    const before = calls();
    controller.type = "examine";
    controller.move({ ...noMovement, forward: 1 }); // nobody walks
    controller.bind(viewpoint("stranger").element);
    assert.equal(calls(), before);
    controller.turn(0.1, 0);
    assert.equal(calls(), before + 1);
    assert.equal(controller.source, "user-interaction");
  });
});
