// A stage -> three.js objects, one per draw and place. What a stage says of its
// vertices, for whoever draws it, is in stageDraws.ts.

import type { BufferGeometry, Group, Material, Matrix4 } from "three";
import type { DrawRange, Stage } from "../decode/stage.ts";
import type { AppearanceDescription } from "../document/description.ts";
import { shapeFromStoredOf } from "../navigation/matrices.ts";
import type { DrawnObject } from "./drawnObject.ts";
import { objectOf } from "./drawnObject.ts";
import type { ShownPictures } from "./look.ts";
import { noPictures } from "./look.ts";
import { PickDraw } from "./pickDraw.ts";
import type { PatchSetting } from "./stageDraws.ts";
import { boundsOf, colorsOf, materialRequestOf, pickRequestOf, setAppearance, uniformsOf } from "./stageDraws.ts";

/** A stage of a patch on the screen, in all places of its shape. It is drawn by objects of its own, or together with others. */
export interface PatchDraws {
  /** For the picking pass: shared by all places. */
  readonly picks: readonly PickDraw[];
  /** In one more place of the scene, in the group that stands there. */
  hang(group: Group): void;
  /** The group has moved, or is shown or hidden. */
  follow(group: Group): void;
  /** Not there any more. */
  leave(group: Group): void;
  applyAppearance(appearance: AppearanceDescription, pictures: ShownPictures): void;
  /** Takes it out of the scene and frees what this stage alone uses. */
  dispose(): void;
}

/** Each draw is an object in each place. */
export function drawStage(stage: Stage, setting: PatchSetting): PatchDraws {
  const { geometry, patch, look, buffers } = setting;
  const { box, sphere } = boundsOf(geometry, patch, stage);
  const shapeFromStored = shapeFromStoredOf(geometry, patch);
  const uniforms = uniformsOf(stage, setting);
  // Without texture coordinates there is nowhere to lay it.
  const laid = (pictures: ShownPictures) => (stage.texCoord !== undefined ? pictures : noPictures);
  let shown = { appearance: setting.appearance, pictures: setting.pictures };
  const draws = setting.geometries.acquire(stage).flatMap((shape, place) => {
    const range = stage.draws[place];
    if (range === undefined || range.count === 0) return [];
    shape.boundingBox = box;
    shape.boundingSphere = sphere;
    const request = materialRequestOf(stage, range, geometry, uniforms.of(range), setting.shared);
    const material = look.makeMaterial(request, setting.appearance, laid(setting.pictures));
    const pick = new PickDraw(stage, range, {
      buffers, bounds: sphere, shapeFromStored,
      makeParts: () => ({ geometry: shape, request: pickRequestOf(stage, range, material.side, uniforms.of(range), shown.appearance, shown.pictures), release: () => undefined }),
    });
    return [{ range, shape, material, request, pick }];
  });
  const objects = new Map<Group, DrawnObject[]>();
  const leave = (group: Group) => {
    for (const object of objects.get(group) ?? []) object.removeFromParent();
    objects.delete(group);
  };
  return {
    picks: draws.map(({ pick }) => pick),
    hang(group) {
      const here = draws.map(({ range, shape, material, request }) => {
        const object = placedObject(range, shape, material, shapeFromStored);
        look.prepare(object, request, material);
        return object;
      });
      if (here.length > 0) group.add(...here);
      objects.set(group, here);
    },
    follow: () => undefined, // objects in it do so by themselves
    leave,
    applyAppearance(appearance, pictures) {
      shown = { appearance, pictures };
      setAppearance(uniforms.common, geometry, appearance);
      for (const { material, pick } of draws) {
        look.applyAppearance(material, appearance, colorsOf(stage), laid(pictures));
        pick.forgetParts();
      }
    },
    dispose() {
      for (const group of Array.from(objects.keys())) leave(group);
      for (const { material, pick } of draws) {
        material.dispose();
        pick.dispose();
      }
      setting.geometries.release(stage);
    },
  };
}

function placedObject(draw: DrawRange, shape: BufferGeometry, material: Material, matrix: Matrix4): DrawnObject {
  const object = objectOf(draw, shape, material);
  object.matrixAutoUpdate = false;
  object.matrix.copy(matrix);
  object.matrixWorldNeedsUpdate = true;
  return object;
}
