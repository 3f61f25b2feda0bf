// The context that the shapes of a scene share in an app's own three.js scene.

import { Vector2, Vector4 } from "three";
import { makeSceneEffectUniforms } from "../render/environment/sceneEffects.ts";
import type { MaterialFactory } from "../render/materials/materialFactory.ts";
import type { ShapeContext } from "../render/shapes/shapeObject.ts";
import { GeometryPool } from "../render/stages/geometryPool.ts";
import type { BufferProvider } from "../render/uploads/bufferProvider.ts";
import type { TextureProvider } from "../render/uploads/textureProvider.ts";

/** Each shape is drawn alone, as three.js' Raycaster requires, and lit by the app's lights. */
export function appShapeContext(
  materialFactory: MaterialFactory,
  buffers: BufferProvider,
  textures: TextureProvider,
): ShapeContext {
  return {
    materialFactory,
    geometries: new GeometryPool(buffers),
    buffers,
    textures,
    batches: undefined,
    drawing: { asPoints: false },
    shared: {
      pixelRatio: { value: 1 },
      viewport: { value: new Vector4() },
      depthRange: { value: new Vector2() },
      ...makeSceneEffectUniforms(),
    },
  };
}
