// Animates a page's scene where its document has nodes that send events. Only then the module that does it is loaded.

import type { FieldChange } from "../animation/documentGraph.ts";
import type { AnimatedScene, PageAnimation } from "../animation/page/pageAnimation.ts";
import type { PoseChange } from "../scene/instanceTree.ts";
import { drawnFieldOf, isOfPose } from "../viewer/drawnFields.ts";

/** Names of elements that send or carry events. */
const namesOfAnimation =
  /^(route|easeineaseout|boolean(filter|toggle)|\w+(sensor|interpolator(2d)?|sequencer|trigger))$/i;

/** A field of an element of the page. */
export interface DocumentChange {
  readonly element: Element;
  /** X3D's name. */
  readonly field: string;
  readonly attribute: string;
  readonly type: { readonly isList: boolean; readonly size: number };
  readonly value: unknown;
}

export interface SceneAnimationHost extends Omit<AnimatedScene, "drawnFieldOf" | "move" | "read"> {
  /** Moves Transforms and vertices. */
  movePoses(changes: readonly PoseChange[]): void;
  /** Gives a field of a geometry node or of its Coordinate other numbers; false: its attribute is to be read. */
  moveVertices(change: DocumentChange): boolean;
  /** Reads attributes that have been written. */
  read(changes: readonly DocumentChange[]): void;
}

export class SceneAnimation {
  readonly #x3d: Element;
  readonly #host: SceneAnimationHost;
  /** The animation of the page's own document. */
  #animation: PageAnimation | undefined;
  /** Those of inlined documents, by their root elements. */
  readonly #inlined = new Map<Element, PageAnimation>();
  #module: Promise<{ readonly PageAnimation: typeof PageAnimation }> | undefined;
  #roots: readonly Element[] = [];
  #isRequested = false;
  #isPaused = false;
  #mayStartByItself = true;
  #isDisposed = false;
  readonly #onVisibility = (): void => {
    this.#applyState();
  };

  constructor(x3d: Element, host: SceneAnimationHost) {
    this.#x3d = x3d;
    this.#host = host;
    document.addEventListener("visibilitychange", this.#onVisibility);
  }

  /** Loads the module if the document needs it. */
  start(): void {
    if (hasAnimation(this.#x3d)) this.#load();
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
      if (!this.#isRequested && records.some(concernsAnimation)) this.#load();
      return records;
    }
    if (records.some(changesGraph)) animation.read();
    return records.filter(
      ({ type, target, attributeName }) =>
        type !== "attributes" || !animation.attributeChanged(target as Element, attributeName ?? ""),
    );
  }

  /** Plays the inlined documents with these root elements, and no others. */
  followInlined(roots: readonly Element[]): void {
    this.#roots = roots;
    for (const [root, animation] of this.#inlined) {
      if (roots.includes(root)) continue;
      animation.dispose();
      this.#inlined.delete(root);
    }
    for (const root of roots) if (!this.#inlined.has(root) && hasAnimation(root)) void this.#playInlined(root);
  }

  /** Call before the document is read: writes attributes that are late. */
  writeAttributes(): void {
    for (const animation of this.#all) animation.writeAttributes();
  }

  /** Call after each frame. */
  onFrame(): void {
    for (const animation of this.#all) animation.onFrame();
  }

  dispose(): void {
    this.#isDisposed = true;
    document.removeEventListener("visibilitychange", this.#onVisibility);
    for (const animation of this.#all) animation.dispose();
  }

  get #all(): readonly PageAnimation[] {
    return [...(this.#animation ? [this.#animation] : []), ...this.#inlined.values()];
  }

  #load(): void {
    this.#isRequested = true;
    void this.#play(this.#x3d).then((animation) => {
      this.#isRequested = animation !== undefined;
      this.#animation = animation;
    });
  }

  async #playInlined(root: Element): Promise<void> {
    const animation = await this.#play(root);
    if (animation === undefined) return;
    // The document may have been removed, or requested twice, while the module was being loaded.
    if (this.#roots.includes(root) && !this.#inlined.has(root)) this.#inlined.set(root, animation);
    else animation.dispose();
  }

  /** Undefined where the module cannot be loaded, with a warning. */
  async #play(root: Element): Promise<PageAnimation | undefined> {
    try {
      const { PageAnimation: Animation } = await (this.#module ??= import("../animation/index.ts"));
      if (this.#isDisposed) return undefined;
      const scene: AnimatedScene = {
        ...this.#host,
        drawnFieldOf,
        move: (changes) => this.#move(changes),
        read: (changes) => {
          this.#host.read(changes as unknown as readonly DocumentChange[]); // elements of a page are DOM elements
        },
      };
      const animation = new Animation(root, scene, this.#mayStartByItself);
      animation.isPaused = this.#isPaused || document.hidden;
      return animation;
    } catch (error) {
      this.#module = undefined;
      this.#host.warn(`the module that animates the scene could not be loaded: ${String(error)}`);
      return undefined;
    }
  }

  #move(changes: readonly FieldChange[]): readonly FieldChange[] {
    const poses = changes.filter(isOfPose);
    if (poses.length > 0) this.#host.movePoses(poses);
    if (poses.length === changes.length) return [];
    return changes.filter(
      (change) => !isOfPose(change) && !this.#host.moveVertices(change as unknown as DocumentChange),
    );
  }

  #applyState(): void {
    for (const animation of this.#all) {
      animation.mayStartByItself = this.#mayStartByItself;
      animation.isPaused = this.#isPaused || document.hidden;
    }
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
    type === "childList" || /^(def|use)$/i.test(attributeName ?? "") || /^route$/i.test((target as Element).localName)
  );
}
