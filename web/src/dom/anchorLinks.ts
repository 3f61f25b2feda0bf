// An <a> element for each Anchor of a scene, so that keyboards, screen readers and the
// browser's own features (new tabs, history) work. A link is visible while it has the
// focus; a click on a shape in an Anchor becomes a click on its link.

import type { AnchorDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { attributeOf } from "../document/element.ts";
import type { CameraController } from "../navigation/cameraController.ts";
import { linksLabel } from "./overlayLabels.ts";

/** Modifier keys of a click. */
type ModifierKeys = Pick<MouseEvent, "ctrlKey" | "metaKey" | "shiftKey" | "altKey">;

export class AnchorLinks {
  readonly #nav: HTMLElement;
  readonly #cameraController: CameraController;
  readonly #warn: (sentence: string) => void;
  readonly #links = new Map<SceneElement, HTMLAnchorElement>();

  constructor(nav: HTMLElement, cameraController: CameraController, warn: (sentence: string) => void) {
    this.#nav = nav;
    nav.ariaLabel = linksLabel;
    this.#cameraController = cameraController;
    this.#warn = warn;
  }

  /** Updates the links to these Anchors. A link that remains keeps the focus. */
  update(anchors: readonly AnchorDescription[]): void {
    const described = new Map(anchors.map((anchor) => [anchor.element, anchor]));
    for (const [element, link] of this.#links) {
      if (described.has(element)) continue;
      link.remove();
      this.#links.delete(element);
    }
    let next = this.#nav.firstElementChild;
    for (const anchor of described.values()) {
      const link = this.#linkOf(anchor);
      if (link === undefined) continue;
      if (link === next) next = link.nextElementSibling;
      else this.#nav.insertBefore(link, next);
    }
    this.#nav.hidden = this.#links.size === 0;
  }

  /** The link of an Anchor; undefined for an Anchor without an http(s) URL. */
  of(anchor: AnchorDescription): HTMLAnchorElement | undefined {
    return this.#links.get(anchor.element);
  }

  /** Clicks the Anchor's link, with the modifier keys of the given click. */
  follow(anchor: AnchorDescription, { ctrlKey, metaKey, shiftKey, altKey }: ModifierKeys): void {
    this.of(anchor)?.dispatchEvent(
      new MouseEvent("click", { view: window, bubbles: true, cancelable: true, ctrlKey, metaKey, shiftKey, altKey }),
    );
  }

  #linkOf({ element, urls, description, target }: AnchorDescription): HTMLAnchorElement | undefined {
    const href = urls.find(isFollowable);
    if (href === undefined) {
      this.#warn(`<anchor> leads nowhere: "${urls[0] ?? ""}" is no http(s) address`);
      this.#links.get(element)?.remove();
      this.#links.delete(element);
      return undefined;
    }
    const link = this.#links.get(element) ?? document.createElement("a");
    link.href = href;
    link.target = target;
    link.rel = "noopener";
    link.textContent = description || href;
    link.onclick = (event) => {
      this.#bindViewpoint(href, event);
    };
    this.#links.set(element, link);
    return link;
  }

  /**
   * Binds the Viewpoint that `#NAME` names, instead of following the link. Without such a Viewpoint, `#NAME` is a
   * fragment of the page.
   */
  #bindViewpoint(href: string, event: Event): void {
    const viewpoint =
      href.startsWith("#") &&
      this.#cameraController.viewpoints.find(({ element }) => attributeOf(element, "DEF") === href.slice(1));
    if (!viewpoint) return;
    event.preventDefault();
    this.#cameraController.bind(viewpoint.element);
  }
}

/** Whether a URL is http(s): a document may not bring `javascript:` or `data:` URLs. */
export function isFollowable(url: string): boolean {
  if (!URL.canParse(url, document.baseURI)) return false;
  return /^https?:$/.test(new URL(url, document.baseURI).protocol);
}
