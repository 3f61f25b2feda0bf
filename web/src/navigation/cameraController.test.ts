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
import { lookedAround, noMovement, moved, movedFor } from "./firstPerson.ts";

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

  test("has the first node on it, or the last of those that want to be bound", () => {
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

  test("takes in a new node that wants to be bound, but an old one only when it is told", () => {
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

describe("a journey", () => {
  const from = poseFraming(sphere);

  test("begins and ends exactly where it should", () => {
    const to = orbited(from, 2, 0.3);
    assert.equal(interpolatePose(from, to, 0), from);
    assert.equal(interpolatePose(from, to, 1), to);
    samePose(interpolatePose(from, to, 1e-9), from, 1e-6);
    samePose(interpolatePose(from, to, 1 - 1e-9), to, 1e-6);
  });

  test("to the other side goes around the scene, never nearer", () => {
    const to = orbited(from, Math.PI * 0.95, 0);
    const distance = from.position.distanceTo(from.center);
    for (let share = 0; share <= 1; share += 0.05) {
      const pose = interpolatePose(from, to, share);
      assert.ok(Math.abs(pose.position.distanceTo(pose.center) - distance) < 1e-6 * distance);
      assert.ok(forwardOf(pose).angleTo(pose.center.clone().sub(pose.position)) < 1e-5);
    }
  });

  test("from or to a centre that is the eye itself stays finite", () => {
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

  test("who walks stays on his level wherever he looks, who flies goes where he looks", () => {
    const lookingDown = lookedAround(upright, 0, -0.8);
    near(moved(lookingDown, 2, 0, 0, true).position, [0, 1.6, -2]);
    near(moved(lookingDown, 2, 0, 0, false).position, [0, 1.6 - 2 * Math.sin(0.8), -2 * Math.cos(0.8)]);
    near(moved(lookingDown, 0, 3, 1, true).position, [3, 2.6, 0]);
  });

  test("who looks straight down still walks ahead", () => {
    const { position } = moved(lookedAround(upright, 0, -10), 2, 0, 0, true);
    near(position, [0, 1.6, -2], 1e-6);
  });

  test("turning to the right looks to the right, in place, and never past the zenith", () => {
    const pose = lookedAround(upright, Math.PI / 2, 0);
    near(forwardOf(pose), [1, 0, 0]);
    near(pose.position, upright.position);
    near(pose.center, [4, 1.6, 0]);
    assert.ok(forwardOf(lookedAround(upright, 0, 9)).y < 1);
    assert.ok(forwardOf(lookedAround(upright, 0, 9)).y > 0.99);
  });

  test("covers speed times time, however it is cut into frames", () => {
    const motion = { ...noMovement, forward: 1 };
    let pose = upright;
    for (let frame = 0; frame < 60; ++frame) pose = movedFor(pose, motion, 1 / 60, 2.5, true);
    near(pose.position, [0, 1.6, -2.5], 1e-9);
  });
});

describe("the navigator", () => {
  const [front, side] = [
    viewpoint("front"),
    viewpoint("side", { position: [10, 0, 0], orientation: [0, 1, 0, Math.PI / 2] }),
  ];
  const [frontPose, sidePose] = [poseOfViewpoint(front), poseOfViewpoint(side)];

  function navigating(changes: Partial<typeof navigationInfo> = {}, viewpoints = [front, side]) {
    let calls = 0;
    const navigator = new CameraController(
      () => {
        calls += 1;
      },
      () => undefined,
    );
    navigator.setScene({ sphere, viewpoints, navigation: { ...navigationInfo, ...changes } });
    return { navigator, calls: () => calls };
  }

  test("starts at the first viewpoint, without a journey", () => {
    const { navigator } = navigating();
    assert.equal(navigator.bound, front.element);
    assert.equal(navigator.isMoving, false);
    samePose(navigator.advance(0), frontPose);
  });

  test("travels to the viewpoint that is bound, in the document's time", () => {
    const { navigator } = navigating({ transitionTime: 2 });
    navigator.bind(side.element);
    samePose(navigator.advance(500), frontPose);
    assert.ok(navigator.isMoving);
    const { position } = navigator.advance(1500);
    assert.ok(position.distanceTo(frontPose.position) > 1 && position.distanceTo(sidePose.position) > 1);
    samePose(navigator.advance(2501), sidePose);
    assert.equal(navigator.isMoving, false);
  });

  test("goes there at once where the document or people want no motion", () => {
    const { navigator: teleporting } = navigating({ transitionType: ["TELEPORT"] });
    const { navigator: reduced } = navigating();
    reduced.isInstant = true;
    for (const navigator of [teleporting, reduced]) {
      navigator.bind(side.element);
      samePose(navigator.advance(0), sidePose);
      assert.equal(navigator.isMoving, false);
    }
  });

  test("returns to a viewpoint when it is bound once more, and to the one before when it is unbound", () => {
    const { navigator } = navigating({ transitionTime: 0 });
    navigator.bind(side.element);
    navigator.turn(0.4, 0.1);
    navigator.bind(side.element);
    samePose(navigator.advance(0), sidePose);
    navigator.bind(side.element, false);
    samePose(navigator.advance(0), frontPose);
  });

  test("follows a bound viewpoint that changes, and leaves people where they are when another does", () => {
    const { navigator } = navigating();
    navigator.turn(0.3, 0);
    const { pose } = navigator;
    const moved = viewpoint("side", { position: [0, 20, 0] });
    navigator.setScene({
      sphere,
      viewpoints: [front, { ...moved, element: side.element }],
      navigation: navigationInfo,
    });
    samePose(navigator.pose, pose);
    navigator.setScene({ sphere, viewpoints: [{ ...moved, element: front.element }], navigation: navigationInfo });
    near(navigator.pose.position, [0, 20, 0]);
  });

  test("without a viewpoint keeps framing what comes, until somebody moves", () => {
    const { navigator } = navigating({}, []);
    const larger = new Sphere(new Vector3(1, 0, 0), 9);
    navigator.setScene({ sphere: larger, viewpoints: [], navigation: navigationInfo });
    samePose(navigator.pose, poseFraming(larger));
    navigator.zoom(0.5);
    const { pose } = navigator;
    navigator.setScene({ sphere, viewpoints: [], navigation: navigationInfo });
    samePose(navigator.pose, pose);
    navigator.isInstant = true;
    navigator.reset();
    samePose(navigator.pose, poseFraming(sphere));
  });

  test("does not move at all where the type is NONE, but still binds", () => {
    const { navigator } = navigating({ type: ["NONE"], transitionTime: 0 });
    for (const act of [
      () => {
        navigator.turn(1, 1);
      },
      () => {
        navigator.zoom(2);
      },
      () => {
        navigator.pan(1, 1);
      },
      () => {
        navigator.showAll();
      },
      () => {
        navigator.reset();
      },
      () => {
        navigator.type = "fly";
      },
      () => {
        navigator.move({ ...noMovement, forward: 1 });
      },
    ]) {
      act();
      samePose(navigator.advance(0), frontPose);
    }
    navigator.bind(side.element);
    samePose(navigator.advance(0), sidePose);
  });

  /** A frame, after which it is told what it asks for. */
  function advance(navigator: CameraController, ms: number, boxes: readonly WorldBox[]): void {
    navigator.advance(ms);
    const { depthCamera: lookout } = navigator;
    if (lookout) navigator.addGroundSamples(lookout, sampleGround(lookout, boxes));
  }

  test("walks on a floor by wheel and by two fingers too, and not on from where it is led elsewhere", () => {
    const floor = { min: [-20, -4, -20], max: [20, -3, 20] } as const;
    const { navigator } = navigating({ type: ["WALK"], speed: 2, transitionTime: 0 });
    navigator.zoom(Math.exp(-0.1));
    navigator.pan(0.1, -0.05);
    for (let ms = 0; ms < 2000; ms += 20) advance(navigator, ms, [floor]);
    near(navigator.pose.position, [-0.2, -1.4, 9.7], 1e-3);
    assert.equal(navigator.isMoving, false);
    assert.equal(navigator.depthCamera, undefined);
    navigator.zoom(Math.exp(-0.2));
    navigator.bind(side.element);
    for (let ms = 2000; ms < 2200; ms += 20) advance(navigator, ms, [floor]);
    samePose(navigator.pose, sidePose);
  });

  test("walks while a key is held, as fast as the document says, and stands still after", () => {
    const { navigator } = navigating({ type: ["WALK"], speed: 2 });
    navigator.advance(0);
    navigator.move({ ...noMovement, forward: 1 });
    navigator.advance(1000); // the first frame only starts the clock
    for (let ms = 1050; ms <= 2000; ms += 50) advance(navigator, ms, []);
    near(navigator.pose.position, [0, 0, 8], 1e-6);
    navigator.move(noMovement);
    assert.equal(navigator.isMoving, false);
    navigator.advance(9000);
    near(navigator.pose.position, [0, 0, 8], 1e-6);
  });

  test("asks for frames only when something has changed", () => {
    const { navigator, calls } = navigating();
    const before = calls();
    navigator.type = "examine";
    navigator.move({ ...noMovement, forward: 1 }); // nobody walks
    navigator.bind(viewpoint("stranger").element);
    assert.equal(calls(), before);
    navigator.turn(0.1, 0);
    assert.equal(calls(), before + 1);
    assert.equal(navigator.source, "user-interaction");
  });
});
