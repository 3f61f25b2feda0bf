// NavigationInfo's `type`: how one may move, and how one moves at first.

/** To turn what is seen, to walk on a level, to fly, or not to move at all. */
export type NavigationType = "examine" | "walk" | "fly" | "none";

/** X3D's names and X3DOM's, by what they come to here. */
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
  /** Those that are named. */
  readonly listed: readonly NavigationType[];
  /** Those that people may choose. */
  readonly allowed: readonly NavigationType[];
}

/** The first name that is known counts; with ANY, or where none is known, people may choose among all. */
export function navigationTypesOf(names: readonly string[]): NavigationTypes {
  const known = names.flatMap((name) => typesByName[name.trim().toUpperCase()] ?? []);
  const isAny = names.some((name) => name.trim().toUpperCase() === "ANY");
  const allowed = isAny || known.length === 0 ? [...known, ...movingTypes] : known;
  return { first: known[0] ?? "examine", listed: Array.from(new Set(known)), allowed: Array.from(new Set(allowed)) };
}
