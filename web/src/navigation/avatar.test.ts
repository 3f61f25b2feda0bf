import assert from "node:assert/strict";
import { test } from "node:test";
import { Sphere, Vector3 } from "three";
import { nodeFields, type Values } from "../document/nodes.ts";
import { avatarOf, clearanceOf } from "./avatar.ts";

const defaults = Object.fromEntries(
  Object.entries(nodeFields.NavigationInfo).map(([name, { defaultValue }]) => [name, defaultValue]),
) as Values<typeof nodeFields.NavigationInfo>;
const room = new Sphere(new Vector3(), 4);
const avatarOfSize = (...avatarSize: number[]) => avatarOf({ ...defaults, avatarSize }, room);

test("an avatar has X3D's size where NavigationInfo states none", () => {
  const standard = { radius: 0.25, height: 1.6, step: 0.75 };
  assert.deepEqual(avatarOf(undefined, room), standard);
  assert.deepEqual(avatarOfSize(0.25), standard);
  assert.deepEqual(avatarOfSize(0.5, 2, 1), { radius: 0.5, height: 2, step: 1 });
});

test("an avatar's radius is never 0, its height and step never negative", () => {
  assert.deepEqual(avatarOfSize(0, 2, -1), { radius: 0.02, height: 2, step: 0 });
  assert.deepEqual(avatarOfSize(-1, -1, 0), { radius: 4e-6, height: 0, step: 0 });
});

test("surfaces nearer than half the avatar's radius are not drawn where it moves, all where the scene turns", () => {
  const avatar = avatarOfSize(0.5);
  assert.deepEqual(
    (["walk", "fly", "examine", "none"] as const).map((type) => clearanceOf(type, avatar)),
    [0.25, 0.25, 0, 0],
  );
});
