import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Sphere, Vector3 } from "three";
import { CameraHome, shownBoundsOf } from "./cameraHome.ts";
import { poseFraming } from "./cameraPose.ts";
import { unsetCamera } from "./orbit.ts";

const scene = new Sphere(new Vector3(), 3);
const grown = new Sphere(new Vector3(), 4);

describe("the home pose", () => {
  test("is the same object until it changes", () => {
    const home = new CameraHome();
    assert.equal(home.follow(poseFraming(scene), unsetCamera, scene), "replaced");
    const { pose } = home;
    assert.equal(home.follow(poseFraming(scene), { ...unsetCamera }, grown), "none");
    assert.equal(home.pose, pose);
  });

  test("without a viewpoint grows with the scene", () => {
    const home = new CameraHome();
    home.follow(undefined, unsetCamera, scene);
    assert.equal(home.follow(undefined, unsetCamera, grown), "grown");
    assert.deepEqual(home.pose, poseFraming(grown));
  });

  test("is replaced by a viewpoint, by another one, and by camera attributes", () => {
    const home = new CameraHome();
    home.follow(undefined, unsetCamera, scene);
    const [first, second] = [poseFraming(scene), poseFraming(grown)];
    assert.equal(home.follow(first, unsetCamera, scene), "replaced");
    assert.equal(home.follow(second, unsetCamera, scene), "replaced");
    assert.equal(home.follow(second, { ...unsetCamera, fieldOfView: 0.3 }, scene), "replaced");
    assert.equal(home.pose.fieldOfView, 0.3);
  });
});

describe("the bounds that the initial view shows", () => {
  test("are those of the scene where nothing moves", () => {
    assert.equal(shownBoundsOf(scene, undefined), scene);
  });

  test("are those of what moves where they contain the scene, otherwise of both", () => {
    const around = new Sphere(new Vector3(1, 0, 0), 4);
    assert.equal(shownBoundsOf(scene, around), around);
    const beside = new Sphere(new Vector3(9, 0, 0), 1);
    assert.ok(Math.abs(shownBoundsOf(scene, beside).radius - 6.5) < 1e-9);
  });
});
