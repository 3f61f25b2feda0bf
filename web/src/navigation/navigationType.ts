// NavigationInfo's `type`: the ways to move that a scene allows, and the first one.

/** Orbiting the scene, walking on the ground, flying, or no movement. */
export type NavigationType = "examine" | "walk" | "fly" | "none";

/** X3D's and X3DOM's names. */
const typesByName: Readonly<Record<string, NavigationType>> = {
  EXAMINE: "examine",
  TURNTABLE: "examine",
  LOOKAT: "examine",
  WALK: "walk",
  GAME: "walk",
  FLY: "fly",
  HELICOPTER: "fly",
  LOOKAROUND: "fly",
  NONE: "none",
};

const movingTypes: readonly NavigationType[] = ["examine", "walk", "fly"];

export interface NavigationTypes {
  readonly first: NavigationType;
  /** The types that the scene names. */
  readonly listed: readonly NavigationType[];
  /** The types that the user may choose. */
  readonly allowed: readonly NavigationType[];
}

/** The first known name is the initial type. With ANY, or without a known name, the user may choose among all. */
export function navigationTypesOf(names: readonly string[]): NavigationTypes {
  const known = names.flatMap((name) => typesByName[name.trim().toUpperCase()] ?? []);
  const isAny = names.some((name) => name.trim().toUpperCase() === "ANY");
  const allowed = isAny || known.length === 0 ? [...known, ...movingTypes] : known;
  return { first: known[0] ?? "examine", listed: Array.from(new Set(known)), allowed: Array.from(new Set(allowed)) };
}
