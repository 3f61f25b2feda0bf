// The scene of a preview: the bases or patches of a document's shapes with their transforms, solid
// materials and lights. A preview equals the runtime's picture of the bases, so
// scenes with any other feature have none.

import type { Matrix4, Sphere } from "three";
import type {
  AppearanceDescription,
  GeometryDescription,
  PatchReference,
  SceneDescription,
  Vec3,
} from "../document/description.ts";
import { hasDeformation } from "../document/deformation.ts";
import type { SceneElement } from "../document/element.ts";
import { isBlended } from "../lighting/materialParameters.ts";
import { BindingStack } from "../navigation/bindingStack.ts";
import type { Pose } from "../navigation/cameraPose.ts";
import { sphereAround } from "../scene/bounds.ts";
import { avatarOf, clearanceOf } from "../navigation/avatar.ts";
import { bindViewpoints, boundPoseOf, homePoseOf } from "../navigation/homePose.ts";
import { shapeFromStoredOf } from "../scene/transforms.ts";
import { navigationTypesOf } from "../navigation/navigationType.ts";
import type { EffectScope } from "../scene/effectScope.ts";
import type { CameraSetting } from "../navigation/orbit.ts";
import type { LightInstance, ShapeInstance } from "../scene/instances.ts";
import { instancesOf } from "../scene/sceneInstances.ts";

export interface PreviewScene {
  /** At least one shape instance. */
  readonly shapes: readonly PreviewShape[];
  readonly lights: readonly LightInstance[];
  readonly headlight: boolean;
  /** Undefined: the canvas is transparent. */
  readonly background: Vec3 | undefined;
  readonly pose: Pose;
  /** Bounds of all visible shapes. */
  readonly sphere: Sphere;
  /** Distance from the camera within which nothing need be displayed. */
  readonly clearance: number;
  /** Whether its picture with all patches is the scene's: no material has extensions, and the background no pictures. */
  readonly isExact: boolean;
}

export interface PreviewShape {
  readonly element: SceneElement;
  readonly geometry: GeometryDescription;
  /** The author's priority. */
  readonly priority: number;
  /** Undefined: the shape is displayed when its patches have arrived. */
  readonly base: PatchReference | undefined;
  readonly appearance: AppearanceDescription;
  readonly sceneFromShape: Matrix4;
  /** Maps the lattice coordinates that the base stores to the shape's coordinates. */
  readonly shapeFromStored: Matrix4;
  readonly effectScope: EffectScope;
}

/** Drawing more would take longer than loading the runtime. */
const maxShapes = 256;
/** Every light is evaluated at every pixel. */
export const maxLights = 8;

/** The preview of a scene; undefined if the scene is empty or has anything that only the runtime can display. */
export function previewSceneOf(scene: SceneDescription, camera: CameraSetting): PreviewScene | undefined {
  const { background, navigation, inlines } = scene;
  if (inlines.length > 0) return undefined;
  const instances = instancesOf(scene);
  const { viewpoints, lods, billboards, hasClippingOrFog } = instances;
  if (hasClippingOrFog || instances.environmentLights.length > 0) return undefined;
  // Pictures of a background arrive later than a preview, which displays their background colour.
  if (background && (background.sky.length > 1 || background.ground.length > 0 || background.transparency > 0))
    return undefined;
  if (lods.length > 0 || billboards.length > 0 || instances.lights.length > maxLights) return undefined;
  const visibleInstances = instances.shapes.filter(
    ({ shape }) => shape.visible && (shape.geometry !== undefined || shape.unreadableGeometry !== undefined),
  );
  const shapes = visibleInstances.slice(0, maxShapes + 1).flatMap((instance) => previewShapeOf(instance) ?? []);
  if (shapes.length === 0 || shapes.length < visibleInstances.length || shapes.length > maxShapes) return undefined;
  const sphere = sphereAround(instances.box);
  const boundViewpoints = new BindingStack<SceneElement>();
  bindViewpoints(boundViewpoints, viewpoints);
  return {
    shapes,
    lights: instances.lights,
    headlight: navigation.headlight,
    background: background?.sky[0]?.color,
    sphere,
    pose: homePoseOf(boundPoseOf(boundViewpoints, viewpoints), camera, sphere),
    clearance: clearanceOf(navigationTypesOf(navigation.type).first, avatarOf(navigation, sphere)),
    isExact:
      (background?.pictures.length ?? 0) === 0 &&
      shapes.every(({ appearance: { material } }) => !("extensions" in material) || material.extensions === undefined),
  };
}

/**
 * The preview of a shape; undefined if it is not of compact, is mapped by operators, is deformed, or is not drawn in
 * opaque colours.
 */
function previewShapeOf({ shape, ...instance }: ShapeInstance): PreviewShape | undefined {
  const { element, geometry, appearance, priority } = shape;
  const {
    patches: [patch],
    base,
  } = geometry ?? { patches: [], base: undefined };
  if (geometry?.ccw !== true || geometry.encoding !== "compact") return undefined;
  if (base !== undefined && !("patchIndex" in base)) return undefined;
  if (base === undefined && !hasPlainPatches(geometry)) return undefined;
  if (patch === undefined || appearance.colorMap !== undefined || appearance.operators) return undefined;
  if (
    appearance.textures.length > 0 ||
    appearance.cubeMap ||
    appearance.alpha.mode === "MASK" ||
    isBlended(appearance, false)
  )
    return undefined;
  return {
    element,
    geometry,
    priority,
    base,
    appearance,
    ...instance,
    shapeFromStored: shapeFromStoredOf(geometry, patch),
  };
}

/** Whether a preview could draw all patches as they are stored. */
function hasPlainPatches(geometry: GeometryDescription): boolean {
  return !hasDeformation(geometry) && geometry.patches.every(({ data }) => data !== undefined && "patchIndex" in data);
}
