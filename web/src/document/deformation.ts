// Skins and displacers of shapes: the attributes of a geometry that move its vertices, and the nodes that move them.

import type { DeformationLayout } from "../stage/deformation.ts";
import { filesOf } from "./attributes.ts";
import type {
  Box3,
  DeformationDescription,
  DeformerDescription,
  GeometryDescription,
  SkinDescription,
} from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, childrenOf, lowerNameOf } from "./element.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** As the converter names them (src/scene/skin.h). */
const attributeNames = {
  joints: (set: number) => `skin.joints${set}`,
  jointWeights: (set: number) => `skin.weights${set}`,
  displacement: (displacer: number) => `displacer.${displacer}`,
  normalDisplacement: (displacer: number) => `displacer.${displacer}.normal`,
} as const;

/** Whether a geometry has attributes that move its vertices. */
export function hasDeformation({ attributes }: GeometryDescription): boolean {
  const names = [attributeNames.joints(0), attributeNames.displacement(0)];
  return attributes.some(({ name }) => names.includes(name));
}

/** The geometry with its deformation; the same one where it has none. */
export function withDeformation(geometry: GeometryDescription): GeometryDescription {
  const named = (name: string) => geometry.attributes.find((attribute) => attribute.name === name);
  const countOf = (name: (n: number) => string) => {
    let count = 0;
    while (named(name(count))) count += 1;
    return count;
  };
  const layout: DeformationLayout = {
    jointSets: countOf(attributeNames.joints),
    displacers: countOf(attributeNames.displacement),
    displacesNormals: named(attributeNames.normalDisplacement(0)) !== undefined,
  };
  const names = [
    ...range(layout.jointSets).flatMap((set) => [attributeNames.joints(set), attributeNames.jointWeights(set)]),
    ...range(layout.displacers).flatMap((n) => [
      attributeNames.displacement(n),
      ...(layout.displacesNormals ? [attributeNames.normalDisplacement(n)] : []),
    ]),
  ];
  const attributes = names.flatMap((name) => named(name) ?? []);
  if (names.length === 0 || attributes.length < names.length) return geometry;
  const patches = geometry.patches.map((patch) => ({
    ...patch,
    deformation: attributes.flatMap((attribute) => filesOf(geometry.attributes, attribute, patch.attributes)),
  }));
  return { ...geometry, deformation: { layout, attributes }, patches };
}

/** A geometry whose vertices move within a box: each patch may be anywhere in it. */
export function withMovingBox(geometry: GeometryDescription, box: Box3): GeometryDescription {
  return { ...geometry, patches: geometry.patches.map((patch) => ({ ...patch, box })) };
}

/**
 * The skin of an HAnimHumanoid whose joints its children USE; undefined, with a warning, where matrices and joints do
 * not belong together, or where it is HAnim's own, with a skinCoord. `lookup`: the element with a DEF.
 */
export function readSkin(
  humanoid: SceneElement,
  children: readonly SceneElement[],
  lookup: (name: string) => SceneElement | undefined,
  warnings: Warning[],
): SkinDescription | undefined {
  const { inverseBindMatrices } = readFields(humanoid, nodeFields.HAnimHumanoid, []);
  if (inverseBindMatrices.length === 0) {
    if (children.some((child) => attributeOf(child, "containerField")?.toLowerCase() === "skincoord"))
      warnings.push({
        element: humanoid,
        message: "has a skinCoord, which pages do not read: its skin stays as it was modelled until `imgeo convert`",
      });
    return undefined;
  }
  const names = children.filter(isJointUse).map((joint) => attributeOf(joint, "USE") ?? "");
  const joints = names.flatMap((name) => lookup(name) ?? []);
  const missing = names.find((name) => lookup(name) === undefined);
  const problem =
    missing !== undefined
      ? `names no joint with DEF="${missing}"`
      : inverseBindMatrices.length !== 16 * joints.length
        ? `has ${inverseBindMatrices.length} numbers in inverseBindMatrices for ${joints.length} joints`
        : inverseBindMatrices.every(Number.isFinite)
          ? undefined
          : "has inverseBindMatrices that are no numbers";
  if (problem !== undefined) {
    warnings.push({ element: humanoid, message: `${problem}: its skin stays as it was modelled` });
    return undefined;
  }
  return { joints, inverseBindMatrices };
}

/** Whether a child of an HAnimHumanoid is there for another node to name it, and is not drawn. */
export function isOnlyNamed(child: SceneElement): boolean {
  const field = (attributeOf(child, "containerField") ?? "").toLowerCase();
  return ["joints", "segments", "sites", "viewpoints", "skincoord", "skinnormal"].includes(field);
}

function isJointUse(child: SceneElement): boolean {
  return lowerNameOf(child) === "hanimjoint" && attributeOf(child, "containerField")?.toLowerCase() === "joints";
}

/** The displacers of a shape, at most as many as its geometry has displacements. `resolve`: what an element USEs. */
export function readDisplacers(
  shape: SceneElement,
  { layout }: DeformationDescription,
  resolve: (element: SceneElement) => SceneElement | undefined,
  warnings: Warning[],
): DeformerDescription["displacers"] {
  const displacers = childrenOf(shape).flatMap((child) => {
    const node = lowerNameOf(child) === "hanimdisplacer" ? resolve(child) : undefined;
    return node ? [{ element: node, weight: readFields(node, nodeFields.HAnimDisplacer, warnings).weight }] : [];
  });
  if (displacers.length > layout.displacers)
    warnings.push({
      element: shape,
      message: `has ${displacers.length} HAnimDisplacers for ${layout.displacers} displacements: the last have no effect`,
    });
  return displacers.slice(0, layout.displacers);
}

function range(count: number): readonly number[] {
  return Array.from({ length: count }, (_, n) => n);
}
