// Describes a view's canvas and its keys to screen readers, and shows by the cursor whether it can be dragged.

import type { NavigationType } from "../navigation/navigationType.ts";
import { keyLabels, navigationTypeLabels } from "./labels.ts";
import type { UserInterface } from "./userInterface.ts";

/** `isStatic`: the canvas takes no input. */
export type DescribeCanvas = (label: string, type: NavigationType, isStatic: boolean) => void;

/** Returns a function that describes the canvas, and announces a navigation type that replaces another. */
export function canvasDescriber(ui: Pick<UserInterface, "canvas" | "announce">): DescribeCanvas {
  const { canvas } = ui;
  let lastType: NavigationType | undefined;
  return (label, type, isStatic) => {
    canvas.setAttribute("aria-label", label);
    // Screen readers pass arrow keys on to the role `application` only.
    canvas.setAttribute("role", isStatic ? "img" : "application");
    canvas.ariaRoleDescription = isStatic ? null : "3D view";
    canvas.ariaDescription = isStatic ? null : keyLabels[type];
    canvas.tabIndex = isStatic ? -1 : 0;
    canvas.classList.toggle("moves", !isStatic);
    if (lastType !== undefined && lastType !== type) ui.announce(`${navigationTypeLabels[type]}. ${keyLabels[type]}`);
    lastType = type;
  };
}
