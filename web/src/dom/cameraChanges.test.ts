import assert from "node:assert/strict";
import { afterEach, beforeEach, describe, mock, test } from "node:test";
import { Quaternion, Vector3 } from "three";
import type { CameraController } from "../navigation/cameraController.ts";
import { CameraChanges } from "./cameraChanges.ts";

type Camera = { -readonly [Name in "pose" | "source" | "viewpointName"]: CameraController[Name] };

/** The pose of a camera that looks along -z from a distance of 3. */
function frontPose(): Camera["pose"] {
  return {
    position: new Vector3(0, 0, 3),
    orientation: new Quaternion(),
    center: new Vector3(),
    up: new Vector3(0, 1, 0),
    fieldOfView: 1,
  };
}

function changesOf(camera: Camera) {
  const sources: string[] = [];
  const announced: string[] = [];
  const changes = new CameraChanges(camera, {
    onChange: ({ source }) => sources.push(source),
    announce: (text) => announced.push(text),
  });
  return { changes, sources, announced };
}

describe("changes of the camera", () => {
  beforeEach(() => {
    mock.timers.enable({ apis: ["setTimeout"] });
  });
  afterEach(() => {
    mock.timers.reset();
  });

  test("are sent once for each frame in which it has moved", () => {
    const camera: Camera = { pose: frontPose(), source: "none", viewpointName: undefined };
    const { changes, sources } = changesOf(camera);
    assert.ok(changes.isStill, "before the first frame");
    changes.onFrame();
    changes.onFrame();
    assert.deepEqual([sources, changes.isStill], [["none"], true]);
    Object.assign(camera, { pose: frontPose(), source: "user-interaction" });
    assert.ok(!changes.isStill);
    changes.onFrame();
    assert.deepEqual([sources, changes.isStill], [["none", "user-interaction"], true]);
  });

  test("are announced after the last one, by the viewpoint's name or the side that is seen", () => {
    const camera: Camera = { pose: frontPose(), source: "user-interaction", viewpointName: undefined };
    const { changes, announced } = changesOf(camera);
    for (let frame = 0; frame < 3; ++frame) {
      camera.pose = frontPose();
      changes.onFrame();
      mock.timers.tick(500);
    }
    assert.deepEqual(announced, []);
    mock.timers.tick(500);
    assert.deepEqual(announced, ["View from the front"]);
    Object.assign(camera, { pose: frontPose(), viewpointName: "The gate" });
    changes.onFrame();
    mock.timers.tick(1000);
    assert.deepEqual(announced, ["View from the front", "The gate"]);
  });

  test("are not announced in the first frame, by automatic rotation, and after the end", () => {
    const camera: Camera = { pose: frontPose(), source: "user-interaction", viewpointName: undefined };
    const { changes, announced } = changesOf(camera);
    changes.onFrame();
    mock.timers.tick(1000);
    Object.assign(camera, { pose: frontPose(), source: "automatic" });
    changes.onFrame();
    mock.timers.tick(1000);
    Object.assign(camera, { pose: frontPose(), source: "user-interaction" });
    changes.onFrame();
    changes.end();
    mock.timers.tick(1000);
    assert.deepEqual(announced, []);
  });
});
