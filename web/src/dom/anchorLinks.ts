// Where a scene's Anchors lead: links of the browser's own, so that keyboards,
// screen readers and the browser's habits (a new tab, going back) find them. They
// are seen while they have the focus; a click on a shape is one on its link.

import type { AnchorDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { attributeOf } from "../document/element.ts";
import type { CameraController } from "../navigation/cameraController.ts";

/** What of the native event a link minds. */
type Keys = Pick<MouseEvent, "ctrlKey" | "metaKey" | "shiftKey" | "altKey">;

export class AnchorLinks {
  readonly #nav: HTMLElement;
  readonly #navigator: CameraController;
  readonly #warn: (sentence: string) => void;
  readonly #links = new Map<SceneElement, HTMLAnchorElement>();

  constructor(nav: HTMLElement, navigator: CameraController, warn: (sentence: string) => void) {
    this.#nav = nav;
    this.#navigator = navigator;
    this.#warn = warn;
  }

  /** The scene has these now. A link that stays keeps the focus. */
  update(anchors: readonly AnchorDescription[]): void {
    const wanted = new Map(anchors.map((anchor) => [anchor.element, anchor]));
    for (const [element, link] of this.#links) {
      if (wanted.has(element)) continue;
      link.remove();
      this.#links.delete(element);
    }
    let next = this.#nav.firstElementChild;
    for (const anchor of wanted.values()) {
      const link = this.#linkOf(anchor);
      if (link === undefined) continue;
      if (link === next) next = link.nextElementSibling;
      else this.#nav.insertBefore(link, next);
    }
    this.#nav.hidden = this.#links.size === 0;
  }

  /** What leads there; undefined where nothing that may be followed does. */
  of(anchor: AnchorDescription): HTMLAnchorElement | undefined {
    return this.#links.get(anchor.element);
  }

  /** As if the link had been clicked with these keys held. */
  follow(anchor: AnchorDescription, { ctrlKey, metaKey, shiftKey, altKey }: Keys): void {
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
      this.#bind(href, event);
    };
    this.#links.set(element, link);
    return link;
  }

  /** `#NAME` is a Viewpoint of the scene, where it has one of that name; else a place of the page. */
  #bind(href: string, event: Event): void {
    const viewpoint =
      href.startsWith("#") &&
      this.#navigator.viewpoints.find(({ element }) => attributeOf(element, "DEF") === href.slice(1));
    if (!viewpoint) return;
    event.preventDefault();
    this.#navigator.bind(viewpoint.element);
  }
}

/** Scripts and data that somebody else's document brings are not. */
export function isFollowable(url: string): boolean {
  if (!URL.canParse(url, document.baseURI)) return false;
  return /^https?:$/.test(new URL(url, document.baseURI).protocol);
}
