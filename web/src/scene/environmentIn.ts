// Finds what a scene has around its shapes and what changes how they look, which pages draw with a part of the runtime
// (document/parts.ts).

import type { BackgroundDescription, GroupDescription, NodeDescription } from "../document/description.ts";

const known = new WeakMap<GroupDescription, boolean>();

/**
 * Whether drawing the nodes of a scene's root needs the part "environment": skies of several colours and pictures, cube
 * maps, EnvironmentLights, clip planes, fogs, or lights of a group. Looks at a group anew only if it has changed.
 */
export function hasEnvironment(root: GroupDescription): boolean {
  return root.children.some((child) => isEnvironment(child));
}

/** A light of a group has a scope, unless the group is the root. */
function hasEnvironmentInGroup(group: GroupDescription): boolean {
  const before = known.get(group);
  if (before !== undefined) return before;
  const has = group.children.some((child) => (child.kind === "light" ? !child.light.global : isEnvironment(child)));
  known.set(group, has);
  return has;
}

function isEnvironment(node: NodeDescription): boolean {
  switch (node.kind) {
    case "group":
      return hasEnvironmentInGroup(node);
    case "shape":
      return node.appearance.cubeMap !== undefined;
    case "background":
      return !hasPlainSky(node.background) || node.background.pictures.length > 0;
    case "clipPlane":
    case "fog":
    case "localFog":
    case "environmentLight":
      return true;
    default:
      return false;
  }
}

/** Whether sky and ground are one opaque colour, which clears the canvas. */
export function hasPlainSky({ sky, ground, transparency }: BackgroundDescription): boolean {
  return sky.length === 1 && ground.length === 0 && transparency === 0;
}
