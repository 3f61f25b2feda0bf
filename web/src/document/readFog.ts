// Reads Fog and LocalFog.

import type { FogDescription, FogNodeDescription, LocalFogDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import type { Values, Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** `element`: the node's identity; `node`: the element with its fields. */
export function readFog(
  element: SceneElement,
  node: SceneElement,
  inlineDepth: number,
  warnings: Warning[],
): FogNodeDescription {
  const fields = readFields(node, nodeFields.Fog, warnings);
  const isBindRequested = fields.set_bind || fields.bind;
  return { kind: "fog", element, inlineDepth, isBindRequested, fog: fogOf(node, fields, warnings) };
}

export function readLocalFog(node: SceneElement, warnings: Warning[]): LocalFogDescription {
  const fields = readFields(node, nodeFields.LocalFog, warnings);
  return { kind: "localFog", enabled: fields.enabled, fog: fogOf(node, fields, warnings) };
}

function fogOf(
  element: SceneElement,
  { color, fogType, visibilityRange }: Pick<Values<typeof nodeFields.Fog>, "color" | "fogType" | "visibilityRange">,
  warnings: Warning[],
): FogDescription {
  const type = (["linear", "exponential"] as const).find((known) => known === fogType.trim().toLowerCase());
  if (type === undefined)
    warnings.push({ element, message: `fogType="${fogType}" is neither LINEAR nor EXPONENTIAL; the fog is linear` });
  return { color, type: type ?? "linear", visibilityRange: Math.max(visibilityRange, 0) };
}
