import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Matrix4, Sphere, Vector3 } from "three";
import { nodeFields, type Values } from "../document/nodes.ts";
import type { ViewpointInstance } from "../scene/instances.ts";
import type { WorldBox } from "./boxWorld.testing.ts";
import { sampleGround } from "./boxWorld.testing.ts";
import { CameraController } from "./cameraController.ts";
import { poseFraming, poseOfViewpoint } from "./cameraPose.ts";
import { noMovement } from "./firstPerson.ts";
import { lateWalkController } from "./lateWalking.ts";
import { assertNear, assertPose } from "./poses.testing.ts";
import { WalkController } from "./walkController.ts";

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
