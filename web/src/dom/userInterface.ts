// The user interface of a view around its canvas: poster, progress bar, hotspots, menus
// and a message. Pages replace or style its elements through slots and parts.

import { viewStyle } from "../element/viewStyle.ts";

export interface UserInterface {
  readonly canvas: HTMLCanvasElement;
  readonly poster: HTMLElement;
  readonly posterImage: HTMLImageElement;
  readonly hotspots: HTMLElement;
  /** Holds the menus and buttons; pages may slot their own controls instead. */
  readonly controls: HTMLElement;
  /** Holds a link for each Anchor of the scene, for keyboards and screen readers. */
  readonly links: HTMLElement;
  /** The dialog for help. */
  readonly help: HTMLDialogElement;
  /** Sets the progress bar, 0 … 1; at 1 it disappears. Screen readers read `label`. */
  showProgress(share: number, label: string): void;
  /** Has screen readers read a text. */
  announce(text: string): void;
  /** Displays a message instead of the canvas. */
  showMessage(text: string): void;
}

/**
 * Fills the shadow root. `preview`: a canvas in the root, which stays in front of the view's canvas and behind all
 * other elements.
 */
export function makeUserInterface(root: ShadowRoot, preview?: HTMLCanvasElement): UserInterface {
  root.adoptedStyleSheets = [viewStyle];
  const canvas = document.createElement("canvas");

  const hotspots = elementOf("div", { class: "hotspots" });
  const posterImage = elementOf("img", { part: "default-poster", alt: "" });
  const poster = elementOf("div", { class: "poster", hidden: "" }, slotOf("poster", posterImage));

  const fill = elementOf("div", {});
  const bar = elementOf(
    "div",
    {
      class: "bar",
      part: "default-progress-bar",
      role: "progressbar",
      "aria-label": "Loading",
      "aria-valuemin": "0",
      "aria-valuemax": "100",
      "aria-valuenow": "0",
    },
    fill,
  );
  const barSlot = slotOf("progress-bar", bar);

  const controls = elementOf("div", { class: "controls", part: "default-controls" });
  const links = elementOf("nav", { class: "links", hidden: "" });
  const spoken = elementOf("p", { class: "spoken", role: "status" });
  const message = elementOf("p", { class: "message", role: "alert", hidden: "" });
  const help = elementOf("dialog", { class: "help", part: "help" });
  const overCanvas = [hotspots, poster, links, slotOf("controls", controls), barSlot, spoken, message, help];
  if (preview?.parentNode === root) {
    preview.before(canvas);
    preview.after(...overCanvas);
  } else {
    root.replaceChildren(canvas, ...overCanvas);
  }

  return {
    canvas,
    poster,
    posterImage,
    hotspots,
    controls,
    links,
    help,
    showProgress(share, label) {
      const percent = Math.floor(share * 100); // 100 only when everything is loaded
      fill.style.transform = `scaleX(${share})`;
      bar.setAttribute("aria-valuenow", String(percent));
      bar.setAttribute("aria-valuetext", `${percent} %, ${label}`);
      bar.classList.toggle("done", share >= 1);
      // A completed progress bar leaves the accessibility tree.
      bar.ariaHidden = share >= 1 ? "true" : null;
    },
    announce(text) {
      spoken.textContent = text;
    },
    showMessage(text) {
      for (const element of [canvas, hotspots, poster, links, barSlot, controls]) element.hidden = true;
      message.hidden = false;
      message.textContent = text;
    },
  };
}

/** A slot with `children` as its default content. */
function slotOf(name: string, ...children: Node[]): HTMLSlotElement {
  return elementOf("slot", { name }, ...children);
}

function elementOf<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  attributes: Readonly<Record<string, string>>,
  ...children: Node[]
): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}
