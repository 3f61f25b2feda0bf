// The table of nodes and fields that the runtime reads, with types and defaults. tests/nodes.test.ts compares it with
// docs/formats/nodes.md and with the converter's table. A few attributes that are not fields of one node (DEF, USE,
// containerField, mapping) are read elsewhere in this folder.

import type { SceneElement } from "./element.ts";
import { attributesOf } from "./element.ts";
import { appearanceNodes } from "./appearanceNodes.ts";
import { ColorMap } from "./colorMaps.ts";
import { boundedObject, prioritized } from "./commonFields.ts";
import type { Field } from "./fieldTypes.ts";
import {
  MFColor,
  MFFloat,
  MFMatrix4f,
  MFString,
  MFUrl,
  optional,
  SFBool,
  SFColor,
  SFFloat,
  SFInt32,
  SFRotation,
  SFString,
  SFVec2f,
  SFVec3f,
  SFVec4f,
} from "./fieldTypes.ts";
import { geometryNodes } from "./geometryNodes.ts";

/** True: the node is bound (set_bind is X3D's event, bind X3DOM's field). */
const bindable = { set_bind: SFBool(false), bind: SFBool(false) };

/** X3D 4's `visible` and X3DOM's older `render`: a node is visible where both are true. */
const visibleObject = { visible: SFBool(true), render: SFBool(true) };

const lightFields = {
  on: SFBool(true),
  color: SFColor([1, 1, 1]),
  intensity: SFFloat(1),
  ambientIntensity: SFFloat(0),
};

const positionedLightFields = {
  location: SFVec3f([0, 0, 0]),
  attenuation: SFVec3f([1, 0, 0]),
  radius: SFFloat(100),
  /** False: it lights only its group's descendants. */
  global: SFBool(true),
};

const backgroundFields = {
  ...bindable,
  skyColor: MFColor([[0, 0, 0]]),
  skyAngle: MFFloat([]),
  groundColor: MFColor([]),
  groundAngle: MFFloat([]),
  transparency: SFFloat(0),
};

const fogFields = {
  color: SFColor([1, 1, 1]),
  fogType: SFString("LINEAR"),
  /** 0: no fog. */
  visibilityRange: SFFloat(0),
};

const transformFields = {
  ...prioritized,
  ...boundedObject,
  ...visibleObject,
  translation: SFVec3f([0, 0, 0]),
  rotation: SFRotation([0, 0, 1, 0]),
  scale: SFVec3f([1, 1, 1]),
  center: SFVec3f([0, 0, 0]),
  scaleOrientation: SFRotation([0, 0, 1, 0]),
};

export const nodeFields = {
  X3D: {
    /** Weights of file contents, for the order of requests. */
    chunkPriority: SFString(""),
  },
  NavigationInfo: {
    ...bindable,
    type: MFString(["EXAMINE", "ANY"]),
    headlight: SFBool(true),
    /** Default: depends on the size of the scene. */
    speed: optional(SFFloat(1)),
    avatarSize: MFFloat([0.25, 1.6, 0.75]),
    transitionType: MFString(["LINEAR"]),
    transitionTime: SFFloat(1),
  },
  Background: {
    ...backgroundFields,
    frontUrl: MFUrl([]),
    backUrl: MFUrl([]),
    leftUrl: MFUrl([]),
    rightUrl: MFUrl([]),
    topUrl: MFUrl([]),
    bottomUrl: MFUrl([]),
  },
  TextureBackground: backgroundFields,
  ClipPlane: { enabled: SFBool(true), plane: SFVec4f([0, 1, 0, 0]) },
  Fog: { ...bindable, ...fogFields },
  LocalFog: { ...fogFields, enabled: SFBool(true) },
  Viewpoint: {
    ...bindable,
    description: SFString(""),
    position: SFVec3f([0, 0, 10]),
    orientation: SFRotation([0, 0, 1, 0]),
    fieldOfView: SFFloat(0.7854),
    centerOfRotation: SFVec3f([0, 0, 0]),
  },
  OrthoViewpoint: {
    ...bindable,
    description: SFString(""),
    position: SFVec3f([0, 0, 10]),
    orientation: SFRotation([0, 0, 1, 0]),
    fieldOfView: MFFloat([-1, -1, 1, 1]),
    centerOfRotation: SFVec3f([0, 0, 0]),
  },
  DirectionalLight: { ...lightFields, global: SFBool(false), direction: SFVec3f([0, 0, -1]) },
  PointLight: { ...lightFields, ...positionedLightFields },
  SpotLight: {
    ...lightFields,
    ...positionedLightFields,
    direction: SFVec3f([0, 0, -1]),
    beamWidth: SFFloat(0.7854),
    cutOffAngle: SFFloat(1.5708),
  },
  EnvironmentLight: {
    ...lightFields,
    global: SFBool(false),
    rotation: SFRotation([0, 0, 1, 0]),
    /** Nine spherical harmonics of the light that falls on a surface, by the direction of its normal. */
    diffuseCoefficients: MFFloat([]),
  },
  Group: { ...prioritized, ...boundedObject, ...visibleObject },
  Anchor: {
    ...prioritized,
    ...boundedObject,
    ...visibleObject,
    url: MFUrl([]),
    description: SFString(""),
    parameter: MFString([]),
  },
  Billboard: { ...prioritized, ...boundedObject, ...visibleObject, axisOfRotation: SFVec3f([0, 1, 0]) },
  LOD: { ...prioritized, ...boundedObject, ...visibleObject, center: SFVec3f([0, 0, 0]), range: MFFloat([]) },
  Inline: { ...prioritized, ...boundedObject, ...visibleObject, load: SFBool(true), url: MFUrl([]) },
  Switch: { ...prioritized, ...boundedObject, ...visibleObject, whichChoice: SFInt32(-1) },
  Transform: transformFields,
  HAnimJoint: transformFields,
  HAnimSite: transformFields,
  HAnimHumanoid: {
    ...transformFields,
    /** From the coordinates of its shapes, as they were modelled, to those of each joint. */
    inverseBindMatrices: MFMatrix4f([]),
  },
  HAnimDisplacer: { name: SFString(""), weight: SFFloat(0) },
  Shape: {
    ...prioritized,
    ...boundedObject,
    ...visibleObject,
    isPickable: SFBool(true),
    /** `DEF#N`: the geometry is patch N of the file of the geometry node DEF. */
    patch: SFString(""),
    /** The name of the vertex attribute whose values color the shape. */
    colorBy: SFString(""),
    colorMap: ColorMap("viridis"),
    /** Default: the range of the attribute's values. */
    colorRange: optional(SFVec2f([0, 1])),
  },
  ...appearanceNodes,
  ...geometryNodes,
} as const;

/** A node's values by field name. */
export type Values<Fields> = {
  readonly [Name in keyof Fields]: Fields[Name] extends Field<infer Value> ? Value : never;
};

/** A problem in the document; a default is used instead of what is written. */
export interface Warning {
  readonly element: SceneElement;
  readonly message: string;
}

/** The node's values: the element's attributes, or the default where one is missing or malformed. */
export function readFields<Fields extends Record<string, Field<unknown>>>(
  element: SceneElement,
  fields: Fields,
  warnings: Warning[],
): Values<Fields> {
  const values: Record<string, unknown> = {};
  const textOf = attributesOf(element);
  for (const [name, field] of Object.entries(fields)) {
    const text = textOf(name);
    const value = text === undefined ? field.defaultValue : field.type.parse(text);
    if (value === undefined && text !== undefined) {
      warnings.push({ element, message: `${name}="${shortened(text)}" is no ${field.type.name}; it counts as absent` });
    }
    values[name] = value ?? field.defaultValue;
  }
  return values as Values<Fields>;
}

/** The beginning of an attribute's text, for messages. */
export function shortened(text: string): string {
  return text.length > 40 ? `${text.slice(0, 40)}…` : text;
}
