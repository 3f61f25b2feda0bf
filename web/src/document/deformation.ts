// Skins of humanoids, and whether a geometry has attributes that move its vertices. deformationReader.ts reads these.

import type { GeometryDescription, SkinDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, lowerNameOf } from "./element.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** As the converter names them (src/scene/skin.h). */
export const deformationNames = {
  joints: (set: number) => `skin.joints${set}`,
  jointWeights: (set: number) => `skin.weights${set}`,
  displacement: (displacer: number) => `displacer.${displacer}`,
  normalDisplacement: (displacer: number) => `displacer.${displacer}.normal`,
} as const;

/** Whether a geometry has attributes that move its vertices. */
export function hasDeformation({ attributes }: GeometryDescription): boolean {
  const names = [deformationNames.joints(0), deformationNames.displacement(0)];
  return attributes.some(({ name }) => names.includes(name));
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
