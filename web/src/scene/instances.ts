// Occurrences of nodes in a scene: a node has several where a group around it is USEd or its document is inlined twice.

import type { Matrix4, Vector4 } from "three";
import type {
  BackgroundNodeDescription,
  EnvironmentLightDescription,
  FogDescription,
  FogNodeDescription,
  LightDescription,
  LodDescription,
  ShapeDescription,
  ViewpointDescription,
} from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { EffectScope } from "./effectScope.ts";

export interface ShapeInstance {
  readonly shape: ShapeDescription;
  readonly sceneFromShape: Matrix4;
  /** The innermost scope that contains the shape. */
  readonly effectScope: EffectScope;
}

export interface LightInstance {
  readonly light: LightDescription;
  readonly sceneFromLight: Matrix4;
  /** The light illuminates the shapes in this scope. */
  readonly scope: EffectScope;
}

export interface LodInstance extends LodDescription {
  readonly sceneFromLod: Matrix4;
}

export interface BackgroundInstance extends BackgroundNodeDescription {
  readonly sceneFromBackground: Matrix4;
}

export interface ClipPlaneInstance {
  /** In scene coordinates; x, y, z have length 1. */
  readonly plane: Vector4;
  /** The plane clips the shapes in this scope. */
  readonly scope: EffectScope;
}

export interface FogInstance extends FogNodeDescription {
  /** Scene units in one unit of the node. */
  readonly scale: number;
}

export interface LocalFogInstance {
  readonly fog: FogDescription;
  /** Scene units in one unit of the node. */
  readonly scale: number;
  /** The fog applies to the shapes in this scope. */
  readonly scope: EffectScope;
}

export interface EnvironmentLightInstance {
  readonly light: EnvironmentLightDescription;
  readonly sceneFromLight: Matrix4;
  /** The light illuminates the shapes in this scope. */
  readonly scope: EffectScope;
}

export interface ViewpointInstance {
  readonly element: SceneElement;
  readonly viewpoint: ViewpointDescription;
  readonly sceneFromViewpoint: Matrix4;
}
