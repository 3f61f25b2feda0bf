// Texts of the overlays: labels, and the gestures and keys that help lists.

import type { NavigationType } from "../navigation/navigationType.ts";

export const hotspotsLabel = "Notes in the scene";
export const linksLabel = "Links in the scene";
export const pictureSavedLabel = "The picture is saved.";
export const closeLabel = "Close";

export const helpTitles: Readonly<Record<NavigationType, string>> = {
  examine: "How to turn the scene",
  walk: "How to walk",
  fly: "How to fly",
  none: "Keys",
};

/** Gestures and keys of a navigation type with their effects, for the help. */
export function gestureRows(type: NavigationType): readonly (readonly [input: string, effect: string])[] {
  return [
    ...(type === "none" ? [] : type === "examine" ? examineRows : travelRows(type)),
    ["P", "points or the surface"],
    ["E, W, F", "examine, walk, fly, where the scene allows it"],
    ["Tab, Escape", "leave the view"],
    ["?", "this help"],
  ];
}

const examineRows = [
  ["Drag, one finger", "turn"],
  ["Two fingers, right button, Shift + drag", "move"],
  ["Pinch, wheel, + and −", "nearer, farther"],
  ["Arrow keys", "turn"],
  ["Shift + arrow keys", "move"],
  ["R", "back to the viewpoint"],
  ["A", "show all"],
] as const;

const travelRows = (type: "walk" | "fly") =>
  [
    ["Drag, one finger", "look around"],
    [
      "Two fingers, right button, Shift + drag",
      type === "walk" ? "step ahead, back and aside" : "step up, down and aside",
    ],
    ["Pinch, wheel, + and −", "ahead, back"],
    ["Arrow keys", "ahead, back, turn, while held"],
    ["Shift + arrow keys", "look up and down, step aside"],
    ["Page Up, Page Down", "up, down"],
    ["R", "back to the viewpoint"],
    ["A", "show all"],
  ] as const;
