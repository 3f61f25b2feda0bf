// Reads the texture coordinates of a geometry node whose numbers are in the document.

import type { Warning } from "./description.ts";
import type { Resolve, SceneElement } from "./element.ts";
import { lowerNameOf } from "./element.ts";
import type { TexCoordMode } from "../tessellate/texCoordModes.ts";
import { nearestTexCoordMode } from "../tessellate/texCoordModes.ts";
import type { VertexData } from "../tessellate/faces.ts";
import { texCoordRoles } from "../stage/attributeRows.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { entryOf } from "./tables.ts";
import { texCoordNodesOf } from "./texCoordNodes.ts";

/**
 * The numbers of the first set, empty where there is none or a generator computes it; and those of further sets that
 * have a name of their own.
 */
export function texCoordSetsOf(
  geometry: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
): Pick<VertexData, "texCoords" | "furtherTexCoords" | "texCoordMappings"> {
  const [first, ...others] = texCoordNodesOf(geometry, resolve);
  const isGenerated = first !== undefined && lowerNameOf(first) !== "texturecoordinate";
  const [texCoords, ...further] = [first, ...others].flatMap((node) =>
    node !== undefined && lowerNameOf(node) === "texturecoordinate"
      ? [readFields(node, nodeFields.TextureCoordinate, warnings)]
      : [],
  );
  const named = further
    .filter(
      ({ mapping }, i) => mapping !== texCoords?.mapping && further.findIndex((each) => each.mapping === mapping) === i,
    )
    .slice(0, texCoordRoles.length - 1);
  const used = isGenerated || texCoords === undefined ? [] : [texCoords, ...named];
  if (Math.max(used.length, 1) < others.length + 1)
    warnings.push({
      element: geometry,
      message:
        `has ${others.length + 1} sets of texture coordinates; the first is used` +
        (used.length > 1 ? `, and ${used.length - 1} that have a mapping of their own` : ""),
    });
  return {
    texCoords: used[0]?.point ?? [],
    furtherTexCoords: used.slice(1).map(({ point }) => point),
    texCoordMappings: used.map(({ mapping }) => mapping),
  };
}

/** How the first set is computed from the vertices; undefined where its numbers are given or there is none. */
export function texCoordModeOf(
  geometry: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
): TexCoordMode | undefined {
  const [first] = texCoordNodesOf(geometry, resolve);
  if (first === undefined || lowerNameOf(first) !== "texturecoordinategenerator") return undefined;
  const { mode } = readFields(first, nodeFields.TextureCoordinateGenerator, warnings);
  const drawn = entryOf(nearestTexCoordMode, mode) ?? "SPHERE-LOCAL";
  // The camera's modes are for cube maps: readCubeMap.ts.
  if (drawn !== mode && !mode.startsWith("CAMERASPACE"))
    warnings.push({ element: first, message: `mode="${mode}" is drawn as ${drawn}` });
  return drawn;
}
