import assert from "node:assert/strict";
import { test } from "node:test";
import { sceneUrlOf } from "./sceneUrl.ts";

test("a viewer's src may name a site's folder, its page or an X3D document", () => {
  for (const [src, url] of [
    ["statue/", "statue/scene.x3d"],
    ["statue", "statue/scene.x3d"],
    [" ../statue/index.html ", "../statue/scene.x3d"],
    ["index.html", "scene.x3d"],
    ["https://cdn.example/a/statue/?v=2#top", "https://cdn.example/a/statue/scene.x3d?v=2"],
    ["parts/wheel.X3D", "parts/wheel.X3D"],
    ["v1.2", "v1.2/scene.x3d"],
    ["./", "./scene.x3d"],
    ["", ""],
    ["#", ""],
  ] as const)
    assert.equal(sceneUrlOf(src), url, src);
});
