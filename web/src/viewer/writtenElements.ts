// Elements whose attributes animation has written: what reading them again needs.

import type { AnimatedElement } from "../animation/elements.ts";
import type { SceneReader } from "../document/sceneReader.ts";

/** Nodes that are read together with their parts. */
const nodesOfParts = /^(shape|texturebackground|environmentlight)$/i;

/** Makes the reader read an element again. `root`: of the page's own document, whose ancestors the reader knows. */
export function touchWritten(
  reader: Pick<SceneReader, "touch">,
  root: AnimatedElement,
  element: AnimatedElement,
): void {
  reader.touch(element);
  const around: AnimatedElement[] = [];
  for (let at = element.parentElement; at !== null; at = at.parentElement) around.push(at);
  if (around.includes(root)) return;
  const node = around.findIndex(({ localName }) => nodesOfParts.test(localName));
  for (const part of around.slice(0, node + 1)) reader.touch(part);
}
