// Animates a page's scene where its document, or one that it inlines, has nodes that send events. Only then the module
// that does it is loaded.

import type * as animatedPage from "./animatedPage.ts";
import type { AnimatedPage, AnimatedPageScene } from "./animatedPage.ts";

/** Names of elements that send or carry events. */
const namesOfAnimation =
  /^(route|easeineaseout|movietexture|boolean(filter|toggle)|\w+(sensor|interpolator(2d)?|sequencer|trigger))$/i;

export type AnimationModule = typeof animatedPage;

/** Loads the module, one for all views of the page. */
let loadModule = (): Promise<AnimationModule> => Promise.reject(new RangeError("the page has no module for animation"));

export function setAnimationImport(load: () => Promise<AnimationModule>): void {
  loadModule = load;
}

export class SceneAnimation {
  readonly #scene: AnimatedPageScene;
  #animation: AnimatedPage | undefined;
  /** The roots of the documents that are inlined and have loaded. */
  #inlined: readonly Element[] = [];
  #isRequested = false;
  #isPaused = false;
  #mayStartByItself = true;
  #isDisposed = false;
  readonly #onVisibility = (): void => {
    this.#applyState();
  };

  /** `scene`: may be incomplete before `start`. */
  constructor(scene: AnimatedPageScene) {
    this.#scene = scene;
    document.addEventListener("visibilitychange", this.#onVisibility);
  }

  /** Loads the module if the document needs it. */
  start(): void {
    if (hasAnimation(this.#x3d)) void this.#load();
  }

  /** `isPaused`: all clocks stand. `mayStartByItself`: clocks run that no event has started. */
  setMotion(isPaused: boolean, mayStartByItself: boolean): void {
    this.#isPaused = isPaused;
    this.#mayStartByItself = mayStartByItself;
    this.#applyState();
  }

  /** Follows changes of the document. Returns those that may concern what is drawn. */
  follow(records: readonly MutationRecord[]): readonly MutationRecord[] {
    const animation = this.#animation;
    if (animation === undefined) {
      if (!this.#isRequested && records.some(concernsAnimation)) void this.#load();
      return records;
    }
    if (records.some(changesGraph)) {
      animation.read();
      queueMicrotask(() => {
        animation.showMotion(); // once the scene has been read
      });
    }
    return records.filter(
      ({ type, target, attributeName }) =>
        type !== "attributes" || !animation.attributeChanged(target as Element, attributeName ?? ""),
    );
  }

  /** Plays the inlined documents with these root elements, and no others. */
  followInlined(roots: readonly Element[]): void {
    if (roots.length === this.#inlined.length && roots.every((root, index) => root === this.#inlined[index])) return;
    this.#inlined = roots;
    if (this.#animation) {
      this.#animation.read();
      this.#animation.showMotion();
    } else if (!this.#isRequested && roots.some(hasAnimation)) void this.#load();
  }

  /** Call before the document is read: writes attributes that are late. */
  writeAttributes(): void {
    this.#animation?.writeAttributes();
  }

  /** Call after each frame. */
  onFrame(): void {
    this.#animation?.onFrame();
  }

  dispose(): void {
    this.#isDisposed = true;
    document.removeEventListener("visibilitychange", this.#onVisibility);
    this.#animation?.dispose();
  }

  /** Without effect where the module cannot be loaded, but for a warning. */
  async #load(): Promise<void> {
    this.#isRequested = true;
    try {
      const module = await loadModule();
      if (this.#isDisposed) return;
      const roots = () => [this.#x3d, ...this.#inlined];
      this.#animation = new module.AnimatedPage(this.#scene, roots, this.#mayStartByItself);
      this.#applyState();
      this.#animation.showMotion();
    } catch (error) {
      this.#isRequested = false;
      this.#scene.core.log.warn(`the module that animates the scene could not be loaded: ${String(error)}`);
    }
  }

  get #x3d(): Element {
    return this.#scene.view.x3d;
  }

  #applyState(): void {
    if (this.#animation === undefined) return;
    this.#animation.mayStartByItself = this.#mayStartByItself;
    this.#animation.isPaused = this.#isPaused || document.hidden;
  }
}

function hasAnimation(element: Element): boolean {
  if (namesOfAnimation.test(element.localName)) return true;
  for (const child of element.getElementsByTagName("*")) if (namesOfAnimation.test(child.localName)) return true;
  return false;
}

function concernsAnimation({ addedNodes }: MutationRecord): boolean {
  for (const node of addedNodes) if (node instanceof Element && hasAnimation(node)) return true;
  return false;
}

/** Whether nodes or routes may have been added, removed or renamed. */
function changesGraph({ type, target, attributeName }: MutationRecord): boolean {
  return (
    type === "childList" ||
    /^(def|use)$/i.test(attributeName ?? "") ||
    /^(route|import|export)$/i.test((target as Element).localName)
  );
}
