// The avatar that NavigationInfo describes, and how near it comes to surfaces.

import type { Sphere } from "three";
import type { NavigationDescription } from "../document/description.ts";
import type { NavigationType } from "./navigationType.ts";
import type { Avatar } from "./walkableGround.ts";

/** The avatar of `avatarSize`, with X3D's defaults. */
export function avatarOf(navigation: NavigationDescription | undefined, sphere: Sphere): Avatar {
  const [radius = 0.25, height = 1.6, step = 0.75] = navigation?.avatarSize ?? [];
  // A lower bound, because a walk is cut into steps of half the radius.
  const minRadius = Math.max(height / 100, sphere.radius * 1e-6);
  return { radius: Math.max(radius, minRadius), height: Math.max(height, 0), step: Math.max(step, 0) };
}

/**
 * Surfaces nearer than this distance need not be drawn: half the avatar's radius (ISO/IEC 19775-1, 23.4.4), 0 in
 * EXAMINE and NONE.
 */
export function clearanceOf(type: NavigationType, { radius }: Avatar): number {
  return type === "walk" || type === "fly" ? radius / 2 : 0;
}
