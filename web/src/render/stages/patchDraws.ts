// Makes three.js objects from a stage: one per draw and instance.

import type { BufferGeometry, Material, Matrix4 } from "three";
import type { DrawRange, Stage } from "../../stage/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import type { EffectScope } from "../../scene/effectScope.ts";
import { sceneScope } from "../../scene/effectScope.ts";
import { shapeFromStoredOf } from "../../scene/transforms.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import { makeDrawnObject } from "../primitives/drawnObject.ts";
import type { ShapeGroup } from "../shapes/shapeGroup.ts";
import type { SurfaceTextures } from "../materials/surfaceTextures.ts";
import { applicableTextures } from "../materials/surfaceTextures.ts";
import { PickDraw } from "../picking/pickDraw.ts";
import type { PatchContext } from "./patchContext.ts";
import { setAppearanceUniforms, uniformsOf } from "./stageUniforms.ts";
import { colorsOf, materialRequestOf, pickRequestOf } from "./materialRequests.ts";
import { sideOf } from "../materials/materialFactory.ts";
import { boundsOf } from "./stageBounds.ts";
import { facesOf, StageOperation } from "./stageOperation.ts";

/**
 * The displayed stage of a patch, in all instances of its shape: drawn by objects of its own (here) or in batches
 * (batches/batchedStage.ts).
 */
export interface PatchDraws {
  /** For the picking pass; shared by all instances. */
  readonly picks: readonly PickDraw[];
  /** Adds an instance of the shape, which `group` holds. */
  addInstance(group: ShapeGroup): void;
  /** Call when the group has moved, has become visible or invisible, or has another effect scope. */
  updateInstance(group: ShapeGroup): void;
  /** Removes an instance. */
  removeInstance(group: ShapeGroup): void;
  applyAppearance(appearance: AppearanceDescription, surfaceTextures: SurfaceTextures): void;
  /** Removes it from the scene and frees what only this stage uses. */
  dispose(): void;
}

/** Draws each draw of the stage by one object per instance. */
export function makePatchDraws(stage: Stage, context: PatchContext): PatchDraws {
  const { geometry, patch, materialFactory, buffers } = context;
  const { box, sphere } = boundsOf(geometry, patch, stage);
  const operation = new StageOperation(geometry, patch, stage, { box, sphere });
  operation.follow(context.appearance);
  const shapeFromStored = shapeFromStoredOf(geometry, patch);
  const uniforms = uniformsOf(stage, context);
  let displayed = { appearance: context.appearance, surfaceTextures: context.surfaceTextures };
  const draws = context.geometries.acquire(stage).flatMap((bufferGeometry, drawIndex) => {
    const range = stage.draws[drawIndex];
    if (range === undefined || range.count === 0) return [];
    bufferGeometry.boundingBox = box;
    bufferGeometry.boundingSphere = sphere;
    const request = {
      ...materialRequestOf(stage, range, geometry, uniforms.of(range), context.shared),
      ...facesOf(geometry, context.appearance),
    };
    const side = sideOf(request);
    const materials = new MaterialPerEffectScope((effectScope) =>
      materialFactory.makeMaterial(
        { ...request, uniforms: { ...request.uniforms, effectScope } },
        displayed.appearance,
        applicableTextures(stage, displayed.appearance, displayed.surfaceTextures),
      ),
    );
    const pick = new PickDraw(stage, range, {
      buffers,
      operation,
      shapeFromStored,
      acquireResources: () => ({
        geometry: bufferGeometry,
        request: pickRequestOf(stage, range, side, uniforms.of(range), displayed.appearance, displayed.surfaceTextures),
        release: () => undefined,
      }),
    });
    return [{ range, bufferGeometry, materials, request, pick }];
  });
  const objects = new Map<ShapeGroup, DrawnObject[]>();
  const removeInstance = (group: ShapeGroup) => {
    for (const object of objects.get(group) ?? []) object.removeFromParent();
    objects.delete(group);
  };
  return {
    picks: draws.map(({ pick }) => pick),
    addInstance(group) {
      const added = draws.map(({ range, bufferGeometry, materials, request }) => {
        const material = materials.of(group);
        const object = objectWithMatrix(range, bufferGeometry, material, shapeFromStored);
        materialFactory.prepareObject(object, request, material);
        operation.setBounds(object);
        return object;
      });
      if (added.length > 0) group.add(...added);
      objects.set(group, added);
    },
    updateInstance(group) {
      // Objects are children of the group and move with it.
      objects.get(group)?.forEach((object, drawIndex) => {
        const { materials, request } = draws[drawIndex] ?? {};
        const material = materials?.of(group);
        if (request === undefined || material === undefined || material === object.material) return;
        object.material = material;
        materialFactory.prepareObject(object, request, material);
      });
    },
    removeInstance,
    applyAppearance(appearance, surfaceTextures) {
      displayed = { appearance, surfaceTextures };
      setAppearanceUniforms(uniforms.common, geometry, appearance, operation.frame);
      operation.follow(appearance);
      for (const object of Array.from(objects.values()).flat()) operation.setBounds(object);
      for (const { materials, pick } of draws) {
        for (const material of materials.all)
          materialFactory.applyAppearance(
            material,
            appearance,
            colorsOf(stage),
            applicableTextures(stage, appearance, surfaceTextures),
          );
        pick.releaseResources();
      }
    },
    dispose() {
      for (const group of Array.from(objects.keys())) removeInstance(group);
      for (const { materials, pick } of draws) {
        for (const material of materials.all) material.dispose();
        pick.dispose();
      }
      context.geometries.release(stage);
    },
  };
}

/** The materials of a draw, one per effect scope of its instances. */
class MaterialPerEffectScope {
  readonly #make: (effectScope: EffectScope) => Material;
  readonly #materials = new Map<EffectScope, Material>();

  constructor(make: (effectScope: EffectScope) => Material) {
    this.#make = make;
  }

  get all(): Iterable<Material> {
    return this.#materials.values();
  }

  of({ effectScope = sceneScope }: ShapeGroup): Material {
    const material = this.#materials.get(effectScope) ?? this.#make(effectScope);
    this.#materials.set(effectScope, material);
    return material;
  }
}

function objectWithMatrix(
  range: DrawRange,
  geometry: BufferGeometry,
  material: Material,
  matrix: Matrix4,
): DrawnObject {
  const object = makeDrawnObject(range, geometry, material);
  object.matrixAutoUpdate = false;
  object.matrix.copy(matrix);
  object.matrixWorldNeedsUpdate = true;
  return object;
}
