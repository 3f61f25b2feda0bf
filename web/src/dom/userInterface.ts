// What people see of a view besides the picture: poster, thin bar, hotspots,
// lists, a message. Pages replace or style them by slots and parts.

import { viewStyle } from "../element/viewStyle.ts";

export interface UserInterface {
  readonly canvas: HTMLCanvasElement;
  readonly poster: HTMLElement;
  readonly posterImage: HTMLImageElement;
  readonly hotspots: HTMLElement;
  /** For lists; pages may put their own controls in its place. */
  readonly controls: HTMLElement;
  /** For those who do not point. */
  readonly links: HTMLElement;
  /** 0 … 1; at 1 the bar goes away. `words` say the same to those who do not see it. */
  showProgress(share: number, words: string): void;
  /** Says something to those who do not see the picture. */
  announce(text: string): void;
  /** Instead of the picture. */
  showMessage(text: string): void;
}

/** Fills the shadow root. `first` is a picture in it that stays, before the canvas and behind the rest. */
export function makeUserInterface(root: ShadowRoot, first?: HTMLCanvasElement): UserInterface {
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
  const links = elementOf("nav", { class: "links", "aria-label": "Links in the scene", hidden: "" });
  const spoken = elementOf("p", { class: "spoken", role: "status" });
  const message = elementOf("p", { class: "message", role: "alert", hidden: "" });
  const above = [hotspots, poster, links, slotOf("controls", controls), barSlot, spoken, message];
  if (first?.parentNode === root) {
    first.before(canvas);
    first.after(...above);
  } else {
    root.replaceChildren(canvas, ...above);
  }

  return {
    canvas,
    poster,
    posterImage,
    hotspots,
    controls,
    links,
    showProgress(share, words) {
      const percent = Math.floor(share * 100); // 100 is said of what is whole alone
      fill.style.transform = `scaleX(${share})`;
      bar.setAttribute("aria-valuenow", String(percent));
      bar.setAttribute("aria-valuetext", `${percent} %, ${words}`);
      bar.classList.toggle("done", share >= 1);
      // What is complete is no progress any more: it leaves the accessibility tree.
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

/** The children stand where the page puts nothing into the slot. */
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
