// Scenes and shapes read from markup, for tests.

import assert from "node:assert/strict";
import type { SceneDescription, ShapeDescription } from "./description.ts";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";

export function sceneOf(markup: string): SceneDescription {
  return readScene(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`));
}

export function onlyShape(markup: string): ShapeDescription {
  const shapes = shapesOf(sceneOf(markup).root);
  assert.equal(shapes.length, 1);
  const shape = shapes[0];
  assert.ok(shape);
  return shape;
}

/** An ImageGeometry of two patches, one of triangles and one of a line. */
export const twoPatches = `
  <ImageGeometry position="1 2 3" size="2 2 2" positionBits="12" solid="false" index="unused.png">
    <GeometryPatch bboxCenter="1 2 3" bboxSize="2 1 1" recordCount="300" primType='"TRIANGLES" "TRIANGLESTRIP"'
      vertexCount="900 12" implicitMeshSize="512 2" index="i.png#1024" coord='"a.png" "b.png#512"' normal="n.png"/>
    <GeometryPatch bboxCenter="1 2 3" bboxSize="1 2 1" recordCount="4" primType="LINESTRIP" vertexCount="4" coord='"c.png" "d.png"'/>
  </ImageGeometry>`;
