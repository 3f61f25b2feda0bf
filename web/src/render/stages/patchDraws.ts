// Makes three.js objects from a stage: one per draw and instance.

import type { BufferGeometry, IUniform, Material, Matrix4, Side } from "three";
import type { DrawRange, Stage } from "../../stage/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import type { EffectScope } from "../../scene/effectScope.ts";
import { sceneScope } from "../../scene/effectScope.ts";
import { shapeFromStoredOf } from "../../scene/transforms.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import { makeDrawnObject } from "../primitives/drawnObject.ts";
import type { ShapeGroup } from "../shapes/shapeGroup.ts";
import { addVisited, removeVisited } from "../shapes/visitedGroup.ts";
import type { SurfaceTextures } from "../materials/surfaceTextures.ts";
import { applicableTextures } from "../materials/surfaceTextures.ts";
import { PickDraw } from "../picking/pickDraw.ts";
import { vertexAttributesOf } from "../attributes/vertexAttributes.ts";
import type { VertexUniforms } from "../shaders/vertexFormat.ts";
import type { PatchContext } from "./patchContext.ts";
import { appearanceUniformsOf, setUniforms, uniformsOf } from "./stageUniforms.ts";
import { colorsOf, materialRequestOf, pickRequestOf } from "./materialRequests.ts";
import { sideOf } from "../materials/materialFactory.ts";
import { boundsOf } from "./stageBounds.ts";
import { lateOperators, operatedFormatOf, operatorsOf } from "../operators/lateOperators.ts";
import type { StageOperation } from "../operators/stageOperation.ts";
import { lateDeformation } from "../deformation/lateDeformation.ts";
import type { StageDeformation } from "../deformation/stageDeformation.ts";

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
  /**
   * Draws another stage with the objects of this one. False, and without effect, unless both are drawn by the same
   * materials from vertices of the same layout; absent: never.
   */
  replaceStage?(stage: Stage, context: PatchContext): boolean;
  /** Removes it from the scene and frees what only this stage uses. */
  dispose(): void;
}

/** A stage that is drawn, and what follows from its description. */
interface DrawnStage {
  readonly stage: Stage;
  readonly context: PatchContext;
  readonly bounds: ReturnType<typeof boundsOf>;
  /** Undefined for a shape without operators. */
  readonly operation: StageOperation | undefined;
  readonly deformation: StageDeformation | undefined;
  readonly shapeFromStored: Matrix4;
}

function drawnStageOf(stage: Stage, context: PatchContext): DrawnStage {
  const { geometry, patch, appearance, buffers, pose } = context;
  const bounds = boundsOf(geometry, patch, stage);
  const operators = operatorsOf(appearance);
  const operation =
    operators && new lateOperators.required.StageOperation(geometry, patch, stage, bounds, operators, buffers);
  const deformation =
    stage.kind === "buffers" && stage.deformation && pose
      ? lateDeformation.added?.ofStage(stage.deformation, pose, geometry, patch)
      : undefined;
  return { stage, context, bounds, operation, deformation, shapeFromStored: shapeFromStoredOf(geometry, patch) };
}

function dispose({ operation, deformation }: DrawnStage): void {
  operation?.dispose();
  deformation?.dispose();
}

/** Draws each draw of the stage by one object per instance. */
export function makePatchDraws(stage: Stage, context: PatchContext): PatchDraws {
  const { materialFactory, buffers, geometries } = context;
  let drawn = drawnStageOf(stage, context);
  const uniforms = uniformsOf(stage, context, ownUniformsOf(drawn));
  let displayed = { appearance: context.appearance, surfaceTextures: context.surfaceTextures };
  const pickOf = (range: DrawRange, bufferGeometry: BufferGeometry, side: Side) => {
    const { bounds, operation, deformation, shapeFromStored, stage } = drawn;
    const { geometry, appearance } = drawn.context;
    const { operatorDefines } = operatedFormatOf(stage, geometry, appearance) ?? {};
    return new PickDraw(stage, range, {
      buffers,
      bounds: bounds.sphere,
      operation,
      deformation,
      shapeFromStored,
      acquireResources: () => ({
        geometry: bufferGeometry,
        request: {
          ...pickRequestOf(stage, range, side, uniforms.of(range), displayed.appearance, displayed.surfaceTextures),
          operatorDefines,
          deformationDefines: deformation?.defines,
        },
        release: () => undefined,
      }),
    });
  };
  const draws = geometries.acquire(stage).flatMap((bufferGeometry, drawIndex) => {
    const range = stage.draws[drawIndex];
    if (range === undefined || range.count === 0) return [];
    setBounds(bufferGeometry, drawn);
    const request = requestOf(drawn, range, uniforms.of(range));
    const side = sideOf(request);
    const materials = new MaterialPerEffectScope((effectScope) =>
      materialFactory.makeMaterial(
        { ...request, uniforms: { ...request.uniforms, effectScope } },
        displayed.appearance,
        applicableTextures(drawn.stage, displayed.appearance, displayed.surfaceTextures),
      ),
    );
    return [{ range, bufferGeometry, materials, request, side, pick: pickOf(range, bufferGeometry, side) }];
  });
  const objects = new Map<ShapeGroup, DrawnObject[]>();
  const removeInstance = (group: ShapeGroup) => {
    for (const object of objects.get(group) ?? []) removeVisited(object);
    objects.delete(group);
  };
  return {
    get picks() {
      return draws.map(({ pick }) => pick);
    },
    addInstance(group) {
      const added = draws.map(({ range, bufferGeometry, materials, request }) => {
        const material = materials.of(group);
        const object = objectWithMatrix(range, bufferGeometry, material, drawn.shapeFromStored);
        materialFactory.prepareObject(object, request, material);
        drawn.operation?.setBounds(object);
        return object;
      });
      addVisited(group, added);
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
      const { context, operation, stage } = drawn;
      operation?.follow(appearance.operators ?? []);
      setUniforms(uniforms.common, { ...appearanceUniformsOf(context.geometry, appearance), ...operation?.uniforms });
      for (const object of Array.from(objects.values()).flat()) operation?.setBounds(object);
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
    replaceStage(stage, context) {
      const next = drawnStageOf(stage, context);
      if (layoutOf(next) !== layoutOf(drawn) || !geometries.replace(drawn.stage, stage)) {
        dispose(next);
        return false;
      }
      dispose(drawn);
      drawn = next;
      displayed = { appearance: context.appearance, surfaceTextures: context.surfaceTextures };
      const nextUniforms = uniformsOf(stage, context, ownUniformsOf(next));
      for (const draw of draws) {
        setBounds(draw.bufferGeometry, next);
        setUniforms(draw.request.uniforms, nextUniforms.of(draw.range));
        draw.pick.dispose();
        draw.pick = pickOf(draw.range, draw.bufferGeometry, draw.side);
      }
      for (const object of Array.from(objects.values()).flat()) {
        object.matrix.copy(next.shapeFromStored);
        object.matrixWorldNeedsUpdate = true;
        next.operation?.setBounds(object);
      }
      return true;
    },
    dispose() {
      for (const group of Array.from(objects.keys())) removeInstance(group);
      for (const { materials, pick } of draws) {
        for (const material of materials.all) material.dispose();
        pick.dispose();
      }
      dispose(drawn);
      geometries.release(drawn.stage);
    },
  };
}

function requestOf<Uniforms extends Partial<VertexUniforms>>(
  { stage, context: { geometry, appearance, shared }, deformation }: DrawnStage,
  range: DrawRange,
  uniforms: Uniforms,
) {
  return {
    ...materialRequestOf(stage, range, geometry, uniforms, shared),
    ...operatedFormatOf(stage, geometry, appearance),
    deformationDefines: deformation?.defines,
  };
}

/** Uniforms of mapped or moving vertices. */
function ownUniformsOf({ operation, deformation }: DrawnStage): Record<string, IUniform> {
  return { ...operation?.uniforms, ...deformation?.uniforms };
}

function setBounds(geometry: BufferGeometry, { bounds: { box, sphere } }: DrawnStage): void {
  geometry.boundingBox = box;
  geometry.boundingSphere = sphere;
}

/** A text that is equal for stages that the same materials draw from vertices of the same layout. */
function layoutOf(drawn: DrawnStage): string {
  const { stage } = drawn;
  const requests = stage.draws.map((range) => ({ ...requestOf(drawn, range, {}), shared: undefined }));
  if (stage.kind === "textures") return JSON.stringify([stage.draws, requests]);
  const attributes = vertexAttributesOf(stage).map(({ name, isNormalized, vertices }) => {
    const { type, components, stride, offset } = vertices;
    return [name, isNormalized, type, components, stride, offset];
  });
  return JSON.stringify([stage.draws, requests, stage.index?.type, attributes]);
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
