import assert from "node:assert/strict";
import { test } from "node:test";
import { Sphere, Vector3 } from "three";
import { nodeFields, type Values } from "../document/nodes.ts";
import { sampleGround } from "./boxWorld.testing.ts";
import { CameraController } from "./cameraController.ts";
import { noMovement } from "./firstPerson.ts";
import { lateWalkController } from "./lateWalking.ts";
import { WalkController } from "./walkController.ts";

const navigation = Object.fromEntries(
  Object.entries(nodeFields.NavigationInfo).map(([name, { defaultValue }]) => [name, defaultValue]),
) as Values<typeof nodeFields.NavigationInfo>;

test("steps and held keys wait for the module of walking, unless something else moves the camera", () => {
  lateWalkController.add(undefined);
  const controller = new CameraController(
    () => undefined,
    () => undefined,
  );
  controller.isInstant = true;
  controller.setScene({
    sphere: new Sphere(new Vector3(), 30),
    viewpoints: [],
    navigation: { ...navigation, type: ["WALK"], speed: 1 },
  });
  const start = controller.pose;
  controller.zoom(0.9);
  controller.reset(); // forgets the step
  controller.pan(0, -0.1);
  controller.move({ ...noMovement, forward: 1 });
  assert.ok(controller.isMoving);
  controller.advance(0);
  controller.advance(1000);
  assert.equal(controller.pose.position.distanceTo(start.position), 0);

  controller.move(noMovement);
  lateWalkController.add(() => new WalkController());
  controller.advance(2000);
  const camera = controller.depthCamera;
  assert.ok(camera !== undefined);
  controller.addGroundSamples(camera, sampleGround(camera, []));
  controller.advance(2016);
  const moved = controller.pose.position.clone().sub(start.position);
  assert.ok(Math.abs(moved.length() - 0.1) < 1e-6, `${moved.length()}`);
});
