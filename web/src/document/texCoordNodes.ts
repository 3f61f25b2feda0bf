// The nodes of texture coordinates that a geometry node can have as children.

import type { Resolve, SceneElement } from "./element.ts";
import { childrenOf, lowerNameOf } from "./element.ts";

const singleNodes = ["texturecoordinate", "texturecoordinategenerator"];

/**
 * The nodes of all sets of texture coordinates, in the order of channels: the children of a MultiTextureCoordinate, or
 * the single node.
 */
export function texCoordNodesOf(geometry: SceneElement, resolve: Resolve): SceneElement[] {
  for (const child of childrenOf(geometry)) {
    const isSingle = singleNodes.includes(lowerNameOf(child));
    if (!isSingle && lowerNameOf(child) !== "multitexturecoordinate") continue;
    const node = resolve(child);
    if (isSingle || node === undefined) return node === undefined ? [] : [node];
    return childrenOf(node).flatMap((set) => (singleNodes.includes(lowerNameOf(set)) ? (resolve(set) ?? []) : []));
  }
  return [];
}
