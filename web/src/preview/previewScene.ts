// What a first look shows of a document: its shapes by their bases, placed, with
// their colours and lights. It shows a scene as the runtime would, or not at all:
// what has anything that it does not know is left to the runtime.

import type { Matrix4, Sphere } from "three";
import type {
  AppearanceDescription,
  GeometryDescription,
  PatchReference,
  SceneDescription,
  Vec3,
} from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { isBlended } from "../lighting/materialParameters.ts";
import { BindingStack } from "../navigation/bindingStack.ts";
import type { Pose } from "../navigation/cameraPose.ts";
import { sphereAround } from "../scene/bounds.ts";
import { avatarOf, bindViewpoints, boundPoseOf, clearanceOf, homePoseOf } from "../navigation/homePose.ts";
import { shapeFromStoredOf } from "../scene/transforms.ts";
import { navigationTypesOf } from "../navigation/navigationType.ts";
import type { LightScope } from "../scene/lightScope.ts";
import type { CameraSetting } from "../navigation/orbit.ts";
import type { LightInstance, ShapeInstance } from "../scene/instances.ts";
import { instancesOf } from "../scene/sceneInstances.ts";

export interface PreviewScene {
  /** At least one; once for each place where one stands. */
  readonly shapes: readonly PreviewShape[];
  readonly lights: readonly LightInstance[];
  readonly headlight: boolean;
  /** Undefined: the page shows through. */
  readonly background: Vec3 | undefined;
  readonly pose: Pose;
  /** Around all that is seen. */
  readonly sphere: Sphere;
  /** What is nearer need not be seen. */
  readonly clearance: number;
}

export interface PreviewShape {
  readonly element: SceneElement;
  readonly geometry: GeometryDescription;
  readonly base: PatchReference;
  readonly appearance: AppearanceDescription;
  readonly sceneFromShape: Matrix4;
  /** Places its lattice. */
  readonly shapeFromStored: Matrix4;
  readonly lightScope: LightScope;
}

/** More would take longer than the runtime does. */
const maxShapes = 256;
/** Each is computed at every pixel. */
export const maxLights = 8;

/** Undefined where the scene has anything that only the runtime can show, or nothing. */
export function previewSceneOf(scene: SceneDescription, camera: CameraSetting): PreviewScene | undefined {
  const { background, navigation, inlines } = scene;
  if (inlines.length > 0 || (background && (background.sky.length > 1 || background.ground.length > 0)))
    return undefined;
  const placement = instancesOf(scene);
  const { viewpoints, lods: levels, billboards } = placement;
  if (levels.length > 0 || billboards.length > 0 || placement.lights.length > maxLights) return undefined;
  const seen = placement.shapes.filter(
    ({ shape }) => shape.visible && (shape.geometry !== undefined || shape.isUnread),
  );
  const shapes = seen.slice(0, maxShapes + 1).flatMap((placed) => previewShapeOf(placed) ?? []);
  if (shapes.length === 0 || shapes.length < seen.length || shapes.length > maxShapes) return undefined;
  const sphere = sphereAround(placement.box);
  const bound = new BindingStack<SceneElement>();
  bindViewpoints(bound, viewpoints);
  return {
    shapes,
    lights: placement.lights,
    headlight: navigation.headlight,
    background: background?.sky[0]?.color,
    sphere,
    pose: homePoseOf(boundPoseOf(bound, viewpoints), camera, sphere),
    clearance: clearanceOf(navigationTypesOf(navigation.type).first, avatarOf(navigation, sphere)),
  };
}

/** Undefined where it is not drawn from a base in solid colours. */
function previewShapeOf({ shape, ...place }: ShapeInstance): PreviewShape | undefined {
  const { element, geometry, appearance } = shape;
  const {
    patches: [patch],
    base,
  } = geometry ?? { patches: [], base: undefined };
  if (geometry === undefined || base === undefined || !("patchIndex" in base)) return undefined;
  if (patch === undefined || appearance.colorMap !== undefined) return undefined;
  if (appearance.textures.length > 0 || appearance.alpha.mode === "MASK" || isBlended(appearance, false))
    return undefined;
  return {
    element,
    geometry,
    base,
    appearance,
    ...place,
    shapeFromStored: shapeFromStoredOf(geometry, patch),
  };
}
