// Reads what moves the vertices of a shape: the attributes of its geometry, and its displacers.

import type { DeformationLayout } from "../stage/deformation.ts";
import { filesOf } from "./attributes.ts";
import { deformationNames } from "./deformation.ts";
import type { Box3, DeformationDescription, DeformerDescription, GeometryDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { childrenOf, lowerNameOf } from "./element.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";

export interface DeformationReader {
  /** The geometry with its deformation, which moves vertices within a box; the same one where it has none. */
  deformed(geometry: GeometryDescription, box: Box3 | undefined): GeometryDescription;
  /** The displacers of a shape, at most as many as its geometry has displacements. `resolve`: what an element USEs. */
  displacersOf(
    shape: SceneElement,
    deformation: DeformationDescription,
    resolve: (element: SceneElement) => SceneElement | undefined,
    warnings: Warning[],
  ): DeformerDescription["displacers"];
}

export const deformationReader: DeformationReader = { deformed, displacersOf };

function deformed(geometry: GeometryDescription, box: Box3 | undefined): GeometryDescription {
  const moved = withDeformation(geometry);
  return moved.deformation && box ? withMovingBox(moved, box) : moved;
}

/** The geometry with its deformation; the same one where it has none. */
function withDeformation(geometry: GeometryDescription): GeometryDescription {
  const named = (name: string) => geometry.attributes.find((attribute) => attribute.name === name);
  const countOf = (name: (n: number) => string) => {
    let count = 0;
    while (named(name(count))) count += 1;
    return count;
  };
  const layout: DeformationLayout = {
    jointSets: countOf(deformationNames.joints),
    displacers: countOf(deformationNames.displacement),
    displacesNormals: named(deformationNames.normalDisplacement(0)) !== undefined,
  };
  const names = [
    ...range(layout.jointSets).flatMap((set) => [deformationNames.joints(set), deformationNames.jointWeights(set)]),
    ...range(layout.displacers).flatMap((n) => [
      deformationNames.displacement(n),
      ...(layout.displacesNormals ? [deformationNames.normalDisplacement(n)] : []),
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
function withMovingBox(geometry: GeometryDescription, box: Box3): GeometryDescription {
  return { ...geometry, patches: geometry.patches.map((patch) => ({ ...patch, box })) };
}

function displacersOf(
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
