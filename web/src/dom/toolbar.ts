// A toolbar with a button for whatever has only keys or methods otherwise: points, full screen, a picture, help. It
// follows the ARIA pattern: one stop of the Tab key, arrow keys move between its buttons.

import type { ToolName } from "./labels.ts";
import { toolLabels, toolbarLabel } from "./labels.ts";

/** What a button does, and whether it is pressed (undefined: it is no switch). */
export interface Tool {
  readonly onClick: () => void;
  readonly isPressed?: () => boolean;
  readonly opensDialog?: boolean;
}

/** Lines of 24 × 24 icons, as SVG paths. */
const icons: Readonly<Record<ToolName, string>> = {
  points: "M5 5h1v1h-1zM12 5h1v1h-1zM18 7h1v1h-1zM8 11h1v1h-1zM15 12h1v1h-1zM5 17h1v1h-1zM12 18h1v1h-1zM18 17h1v1h-1z",
  fullScreen: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  picture: "M3 8h4l2-3h6l2 3h4v11H3zM12 10a3.5 3.5 0 1 0 0 7a3.5 3.5 0 1 0 0-7",
  help: "M8.5 9a3.5 3.5 0 1 1 5.2 3.1C12.5 12.8 12 13.4 12 15M12 19h.01",
};

export class Toolbar {
  readonly #bar = document.createElement("div");
  readonly #buttons = new Map<ToolName, HTMLButtonElement>();
  readonly #tools: Readonly<Record<ToolName, Tool>>;

  /** Appends the toolbar to `controls`; its listeners end with `signal`. */
  constructor(controls: HTMLElement, tools: Readonly<Record<ToolName, Tool>>, signal: AbortSignal) {
    this.#tools = tools;
    this.#bar.className = "tools";
    this.#bar.setAttribute("part", "tools");
    this.#bar.setAttribute("role", "toolbar");
    this.#bar.setAttribute("aria-label", toolbarLabel);
    for (const name of Object.keys(toolLabels) as ToolName[]) this.#addButton(name, signal);
    controls.append(this.#bar);
    this.#bar.addEventListener(
      "keydown",
      (event) => {
        this.#moveFocus(event);
      },
      { signal },
    );
    this.#bar.addEventListener(
      "focusin",
      (event) => {
        this.#setTabStop(event.target as HTMLElement);
      },
      { signal },
    );
    this.update(true);
  }

  /** Shows what is pressed now. `isShown`: whether the view takes camera input; a still picture has no tools. */
  update(isShown: boolean): void {
    this.#bar.hidden = !isShown;
    for (const [name, button] of this.#buttons) {
      const pressed = this.#tools[name].isPressed?.();
      if (pressed !== undefined) button.ariaPressed = String(pressed);
    }
  }

  /** Hides a tool that the browser does not have. */
  hide(name: ToolName): void {
    const button = this.#buttons.get(name);
    if (button === undefined) return;
    button.hidden = true;
    this.#setTabStop(this.#shownButtons[0]);
  }

  get #shownButtons(): HTMLButtonElement[] {
    return Array.from(this.#buttons.values()).filter(({ hidden }) => !hidden);
  }

  #addButton(name: ToolName, signal: AbortSignal): void {
    const { onClick, opensDialog = false } = this.#tools[name];
    const button = document.createElement("button");
    button.type = "button";
    button.ariaLabel = button.title = toolLabels[name];
    if (opensDialog) button.ariaHasPopup = "dialog";
    button.append(iconOf(icons[name]));
    button.tabIndex = this.#buttons.size === 0 ? 0 : -1;
    button.addEventListener("click", onClick, { signal });
    this.#buttons.set(name, button);
    this.#bar.append(button);
  }

  #moveFocus(event: KeyboardEvent): void {
    const buttons = this.#shownButtons;
    const at = buttons.indexOf(event.target as HTMLButtonElement);
    const next = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: -1 }[event.key];
    if (at < 0 || next === undefined) return;
    event.preventDefault();
    buttons.at(next % buttons.length)?.focus();
  }

  #setTabStop(stop: HTMLElement | undefined): void {
    for (const button of this.#buttons.values()) button.tabIndex = button === stop ? 0 : -1;
  }
}

function iconOf(path: string): SVGSVGElement {
  const namespace = "http://www.w3.org/2000/svg";
  const icon = document.createElementNS(namespace, "svg");
  icon.setAttribute("viewBox", "0 0 24 24");
  icon.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(namespace, "path");
  line.setAttribute("d", path);
  icon.append(line);
  return icon;
}
