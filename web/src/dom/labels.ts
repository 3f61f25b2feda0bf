// Texts of the user interface, and labels and descriptions for screen readers.

import type { StageName } from "../stage/stage.ts";
import type { NavigationType } from "../navigation/navigationType.ts";
import type { Orbit } from "../navigation/orbit.ts";

export const stageLabels: Readonly<Record<StageName | "none", string>> = {
  none: "nothing is shown yet",
  points: "the scene is shown as points",
  base: "a coarse version is shown, details are loading",
  surface: "the surface is shown, details are loading",
  shaded: "the shaded surface is shown, details are loading",
  full: "all details are shown",
};

/** The keys of each navigation type, for the description of the canvas. */
export const keyLabels: Readonly<Record<NavigationType, string>> = {
  examine:
    "Arrow keys turn, with Shift they move, plus and minus zoom, R goes back to the start, A shows all, P shows points or the surface, a question mark lists all keys and gestures.",
  walk: "Arrow keys walk and turn, with Shift they look up and down and step aside, R goes back to the start, a question mark lists all keys and gestures.",
  fly: "Arrow keys fly and turn, with Shift they look up and down and step aside, Page Up and Page Down rise and sink, R goes back to the start, a question mark lists all keys and gestures.",
  none: "",
};

export const drawingLabels = { surface: "Shown as a surface", points: "Shown as points" } as const;

export const navigationTypeLabels: Readonly<Record<NavigationType, string>> = {
  examine: "Examining",
  walk: "Walking",
  fly: "Flying",
  none: "Staying",
};

/** The label of a view as a landmark, from the label of its scene. */
export const regionLabelOf = (label: string): string => `3D view: ${label}`;

export const toolbarLabel = "Tools of the view";

/** In the order of the toolbar. */
export const toolLabels = {
  points: "Points",
  fullScreen: "Full screen",
  picture: "Save picture",
  help: "Help",
} as const;
export type ToolName = keyof typeof toolLabels;

export const fullScreenRefusedLabel = "The browser does not allow full screen here.";
const sides = [
  "the front",
  "the front right",
  "the right",
  "the back right",
  "the back",
  "the back left",
  "the left",
  "the front left",
];

/** Describes an orbit's direction as one of eight sides and three heights. */
export function viewLabelOf({ theta, phi }: Pick<Orbit, "theta" | "phi">): string {
  const side = sides[((Math.round(theta / (Math.PI / 4)) % 8) + 8) % 8] ?? "";
  if (phi < Math.PI / 8) return "View from above";
  if (phi > (7 * Math.PI) / 8) return "View from below";
  const height = phi < (3 * Math.PI) / 8 ? ", from above" : phi > (5 * Math.PI) / 8 ? ", from below" : "";
  return `View from ${side}${height}`;
}
