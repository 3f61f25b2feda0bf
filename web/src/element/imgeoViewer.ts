// <imgeo-viewer src="statue/">: displays a converted site in any page. It holds an <x3d> whose scene inlines the site's
// document, hands its attributes and slotted children to that <x3d>, and passes on the events and members of it.

import { viewAttributes } from "./attributes.ts";
import { ensureViewIn } from "./sceneNodes.ts";
import { sceneUrlOf } from "./sceneUrl.ts";
import { loadingProperties, viewEventNames, viewMethods, viewProperties } from "./viewMembers.ts";
import { adoptPageStyle } from "./viewStyle.ts";

export const viewerTag = "imgeo-viewer";

/** Attributes that <x3d> gets from the viewer. */
const passedAttributes: readonly string[] = [...Object.keys(viewAttributes), "aria-label", "title", "chunkpriority"];

/** The attributes that the runtime changes, which the viewer gets back. */
const returnedAttributes = ["draw-as"];

export class ImgeoViewer extends HTMLElement {
  static readonly observedAttributes: readonly string[] = ["src", ...passedAttributes];

  /** Made when the viewer is connected for the first time; kept when it is removed. */
  #x3d: Element | undefined;

  /** The element that the runtime displays; undefined before the viewer is in a page. */
  get x3d(): Element | undefined {
    return this.#x3d;
  }

  /** The attribute `src`. */
  get src(): string {
    return this.getAttribute("src") ?? "";
  }

  set src(src: string) {
    this.setAttribute("src", src);
  }

  connectedCallback(): void {
    const x3d = this.#x3d ?? this.#makeX3d();
    const root = this.getRootNode();
    if (!(root instanceof ShadowRoot)) return;
    // The runtime finds the <x3d> elements of the document alone, and the document's style ends at the shadow root.
    adoptPageStyle(root);
    ensureViewIn(x3d);
  }

  attributeChangedCallback(name: string): void {
    if (this.#x3d === undefined) return;
    if (name === "src") this.#setSource(this.#x3d);
    else copyAttribute(this, this.#x3d, name);
  }

  #makeX3d(): Element {
    // A copy of a viewer (cloneNode) brings the <x3d> of the original.
    const x3d = (this.#x3d = childOf(this, "x3d") ?? document.createElement("x3d"));
    for (const name of passedAttributes) copyAttribute(this, x3d, name);
    this.#setSource(x3d);
    for (const name of viewEventNames) {
      x3d.addEventListener(name, (event) => {
        this.dispatchEvent(new CustomEvent<unknown>(name, { detail: (event as CustomEvent<unknown>).detail }));
      });
    }
    new MutationObserver(() => {
      for (const name of returnedAttributes) copyAttribute(x3d, this, name);
    }).observe(x3d, { attributeFilter: returnedAttributes });
    new MutationObserver(() => {
      this.#adoptChildren(x3d);
    }).observe(this, { childList: true });
    this.append(x3d);
    this.#adoptChildren(x3d);
    return x3d;
  }

  /** Has the scene inline the document that `src` names; without `src` the scene is empty. */
  #setSource(x3d: Element): void {
    const url = sceneUrlOf(this.src);
    const scene = childOf(x3d, "scene") ?? x3d.appendChild(document.createElement("scene"));
    const inline = childOf(scene, "inline");
    if (url === "") {
      inline?.remove();
      return;
    }
    const target = inline ?? document.createElement("inline");
    if (target.getAttribute("url") !== url) target.setAttribute("url", url);
    if (inline === undefined) scene.append(target);
  }

  /**
   * Moves slotted children (hotspots, a poster …) into the <x3d>. A saved page brings an <x3d> of its own, too late.
   */
  #adoptChildren(x3d: Element): void {
    for (const child of Array.from(this.children)) {
      if (child === x3d) continue;
      if (child.hasAttribute("slot")) x3d.append(child);
      else if (child.localName === "x3d") child.remove();
    }
  }
}

// The members of the <x3d>, which are undefined until the runtime has been loaded.
for (const name of [...viewMethods, ...viewProperties, ...loadingProperties]) {
  Object.defineProperty(ImgeoViewer.prototype, name, {
    get(this: ImgeoViewer): unknown {
      return (this.x3d as unknown as Record<string, unknown> | undefined)?.[name];
    },
    configurable: true,
    enumerable: true,
  });
}

/**
 * Defines <imgeo-viewer>. False if the page has it already: another runtime, of another site or version, came first.
 */
export function defineViewer(): boolean {
  if (customElements.get(viewerTag) !== undefined) return false;
  customElements.define(viewerTag, ImgeoViewer);
  return true;
}

function childOf(parent: Element, name: string): Element | undefined {
  return Array.from(parent.children).find(({ localName }) => localName === name);
}

function copyAttribute(from: Element, to: Element, name: string): void {
  const value = from.getAttribute(name);
  if (value === to.getAttribute(name)) return;
  if (value === null) to.removeAttribute(name);
  else to.setAttribute(name, value);
}
