import assert from "node:assert/strict";
import { test } from "node:test";
import type { ShapeDescription } from "../../document/description.ts";
import { shapesOf } from "../../document/description.ts";
import { elementsOf } from "../../document/elements.testing.ts";
import { readScene } from "../../document/readScene.ts";
import { minBatchedInstances } from "../../document/parts.ts";
import { BatchingPlan, maxMergedVertices } from "./batchingPlan.ts";

function geometry(name: string, vertices: number, profile = "compact"): string {
  const patch = `<GeometryPatch recordCount="${vertices}" vertexCount="3" coord="${name}.png" data="${name}.png"/>`;
  return `<ImageGeometry DEF="${name}" profile="${profile}">${patch}</ImageGeometry>`;
}

function planOf(instances: readonly ShapeDescription[]): BatchingPlan {
  const plan = new BatchingPlan();
  for (const { geometry: description } of instances) if (description) plan.add(description);
  return plan;
}

/** The draw mode of each of the scene's shapes. */
function drawModes(shapes: readonly string[], blending: "opaque" | "blended" = "opaque"): string[] {
  const scene = readScene(elementsOf(`<X3D>${shapes.map((inner) => `<Shape>${inner}</Shape>`).join("")}</X3D>`));
  const instances = shapesOf(scene.root);
  const plan = planOf(instances);
  return instances.map(({ geometry: description }) =>
    description ? plan.drawModesOf(description)[blending] : "nothing",
  );
}

const smallMeshes = Array.from({ length: minBatchedInstances }, (_, n) => geometry(`small${n}`, 24));

test("in a scene of few shapes, each shape is drawn alone", () => {
  const shapes = [...smallMeshes.slice(2), '<ImageGeometry USE="small3"/>'];
  assert.deepEqual(new Set(drawModes(shapes)), new Set(["alone"]));
});

test("in a scene of many shapes, small meshes are merged and large ones are drawn alone", () => {
  const shapes = [...smallMeshes, geometry("large", maxMergedVertices + 1), geometry("unknownSize", 0)];
  assert.deepEqual(drawModes(shapes), [...smallMeshes.map(() => "merged"), "alone", "alone"]);
});

test("in a scene of many shapes, blended shapes are never drawn alone, so that they can be sorted", () => {
  const shapes = [...smallMeshes, geometry("large", maxMergedVertices + 1), geometry("image", 24, "classic")];
  assert.deepEqual(drawModes(shapes, "blended"), [...smallMeshes.map(() => "merged"), "instanced", "instanced"]);
  assert.deepEqual(new Set(drawModes(smallMeshes.slice(1), "blended")), new Set(["alone"]));
});

test("a mesh is merged while all its instances together are small, and instanced beyond that", () => {
  const withTwin = (vertices: number) => [...smallMeshes, geometry("twin", vertices), '<ImageGeometry USE="twin"/>'];
  assert.deepEqual(drawModes(withTwin(maxMergedVertices / 2)).slice(-2), ["merged", "merged"]);
  assert.deepEqual(drawModes(withTwin(maxMergedVertices / 2 + 1)).slice(-2), ["instanced", "instanced"]);
});

test("vertices that the GPU decodes are in images, not in buffers, and are never merged", () => {
  const shapes = [
    ...smallMeshes,
    geometry("image", 24, "classic"),
    geometry("images", 24, "classic"),
    '<ImageGeometry USE="images"/>',
  ];
  assert.deepEqual(drawModes(shapes).slice(-3), ["alone", "instanced", "instanced"]);
});

test("after shapes come and go, the remaining ones are drawn as in a new scene", () => {
  const scene = readScene(
    elementsOf(
      `<X3D>${[...smallMeshes, geometry("twin", maxMergedVertices / 2), '<ImageGeometry USE="twin"/>']
        .map((inner) => `<Shape>${inner}</Shape>`)
        .join("")}</X3D>`,
    ),
  );
  const geometries = shapesOf(scene.root).flatMap(({ geometry: description }) => description ?? []);
  const plan = planOf(shapesOf(scene.root));
  const twin = geometries.at(-1);
  assert.ok(twin);
  plan.add(twin);
  assert.equal(plan.drawModesOf(twin).opaque, "instanced");
  plan.remove(twin);
  assert.equal(plan.drawModesOf(twin).opaque, "merged");
  for (const removed of geometries.slice(0, 3)) plan.remove(removed);
  assert.equal(plan.drawModesOf(twin).opaque, "alone");
});
