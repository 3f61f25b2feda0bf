// Animates a page's scene where its document, or one that it inlines, has nodes that send events. Only then the module
// that does it is loaded.

import type { FieldChange } from "../animation/documentGraph.ts";
import type { AnimatedScene, PageAnimation, PageDocuments } from "../animation/page/pageAnimation.ts";
import type { PoseChange } from "../scene/instanceTree.ts";
import { drawnFieldOf, isOfPose } from "../viewer/drawnFields.ts";
import type { VisitMoments } from "../viewer/motionSphere.ts";

/** Names of elements that send or carry events. */
const namesOfAnimation =
  /^(route|easeineaseout|movietexture|boolean(filter|toggle)|\w+(sensor|interpolator(2d)?|sequencer|trigger))$/i;

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
  /** The root of the document that an Inline displays; undefined before it has loaded. */
  documentOf(inline: Element): Element | undefined;
  /** Moves Transforms and vertices. */
  movePoses(changes: readonly PoseChange[]): void;
  /** Gives a field of a geometry node or of its Coordinate other numbers; false: its attribute is to be read. */
  moveVertices(change: DocumentChange): boolean;
  /** Reads attributes that have been written. */
  read(changes: readonly DocumentChange[]): void;
  /** What the document's clocks move may have changed. */
  onMotion(visitMoments: VisitMoments): void;
}

export class SceneAnimation {
  readonly #x3d: Element;
  readonly #host: SceneAnimationHost;
  #animation: PageAnimation | undefined;
  /** The roots of the documents that are inlined and have loaded. */
  #inlined: readonly Element[] = [];
  #isRequested = false;
  #isPaused = false;
  #mayStartByItself = true;
  #isDisposed = false;
  readonly #onVisibility = (): void => {
    this.#applyState();
  };

  readonly #onMotion = (): void => {
    const animation = this.#animation;
    if (animation === undefined || this.#isDisposed) return;
    this.#host.onMotion((visit) => {
      animation.visitMoments(visit);
    });
  };

  constructor(x3d: Element, host: SceneAnimationHost) {
    this.#x3d = x3d;
    this.#host = host;
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
      queueMicrotask(this.#onMotion); // once the scene has been read
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
      this.#onMotion();
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
      const { PageAnimation: Animation } = await import("../animation/index.ts");
      if (this.#isDisposed) return;
      this.#animation = new Animation(this.#documents(), this.#scene(), this.#mayStartByItself);
      this.#applyState();
      this.#onMotion();
    } catch (error) {
      this.#isRequested = false;
      this.#host.warn(`the module that animates the scene could not be loaded: ${String(error)}`);
    }
  }

  #documents(): PageDocuments {
    const roots = (): readonly Element[] => [this.#x3d, ...this.#inlined];
    return {
      get roots() {
        return roots();
      },
      documentOf: (inline) => this.#host.documentOf(inline as unknown as Element), // those of a page are DOM elements
    };
  }

  #scene(): AnimatedScene {
    return {
      ...this.#host,
      drawnFieldOf,
      move: (changes) => this.#move(changes),
      read: (changes) => {
        this.#host.read(changes as unknown as readonly DocumentChange[]); // elements of a page are DOM elements
      },
    };
  }

  #move(changes: readonly FieldChange[]): readonly FieldChange[] {
    const poses = changes.every(isOfPose) ? changes : changes.filter(isOfPose); // without a copy where all are
    if (poses.length > 0) this.#host.movePoses(poses);
    if (poses.length === changes.length) return [];
    return changes.filter(
      (change) => !isOfPose(change) && !this.#host.moveVertices(change as unknown as DocumentChange),
    );
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
