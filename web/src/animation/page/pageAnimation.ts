// The animation of a page's <x3d> and of the documents that it inlines: its player, its sensors, and what scripts see of both.

import type { AnimatedDocuments } from "../documents.ts";
import type { DrawnFieldOf, FieldChange } from "../documentGraph.ts";
import type { AnimatedElement } from "../elements.ts";
import { attributeNameIn } from "../elements.ts";
import { AnimationPlayer } from "../player.ts";
import type { Quaternion } from "../rotations.ts";
import { multiply } from "../rotations.ts";
import type { Point } from "../rays.ts";
import type { LocalView } from "../viewSensors.ts";
import { ViewSensor } from "../viewSensors.ts";
import { inverseOf, product, rotationIn, transformPoint } from "./matrices.ts";
import type { Matrix } from "./matrices.ts";
import { isSequenceFraction } from "../interpolators.ts";
import { visitMoments } from "../motionMoments.ts";
import { MovieTexture } from "../movieTexture.ts";
import { LateAttributes } from "./lateAttributes.ts";
import { OutputEvents, addOutputHandler } from "./outputEvents.ts";
import type { PointerSpace } from "./pointerSensing.ts";
import { PointerSensing } from "./pointerSensing.ts";
import { scriptValueOf, valueFromScript } from "./scriptValues.ts";

/** The viewer in scene coordinates. */
export interface SceneView {
  readonly position: Point;
  readonly orientation: Quaternion;
  readonly centerOfRotation: Point;
  readonly clipFromScene: Matrix;
}

/** What the animation needs of the view of its scene. */
export interface AnimatedScene extends PointerSpace {
  readonly drawnFieldOf: DrawnFieldOf;
  /**
   * Displays values that fields of drawn nodes have received, as far as the document need not be read for it. Returns
   * the others.
   */
  move(changes: readonly FieldChange[]): readonly FieldChange[];
  /** Reads attributes that have been written. */
  read(changes: readonly FieldChange[]): void;
  /** What `move` and `read` display is a frame, and is drawn at once. */
  drawFrame(): void;
  /** An interpolator with the frames of a sequence has received a fraction, 0 … 1. */
  showFraction(interpolator: AnimatedElement, fraction: number): void;
  /** The duration of the sequence that an interpolator or a movie plays, in seconds; 0 until it is known. */
  sequenceDurationOf(element: AnimatedElement): number;
  /** Calls back so that the changes of attributes that it makes are not reported. */
  withoutReports(write: () => void): void;
  /** Attributes of an element that is drawn have been written: the next reading sees them. */
  touch(element: AnimatedElement): void;
  /** The view of the last frame; undefined before the first. */
  view(): SceneView | undefined;
  /** One sentence for the author. */
  warn(message: string): void;
}

/** A page's document and those that it inlines. */
export interface PageDocuments extends AnimatedDocuments {
  readonly roots: readonly Element[];
}

interface ScriptAccess {
  getFieldValue?: (field: string) => unknown;
  setFieldValue?: (field: string, value: unknown) => void;
}

export class PageAnimation {
  readonly #scene: AnimatedScene;
  readonly #documents: PageDocuments;
  readonly #player: AnimationPlayer;
  readonly #events = new OutputEvents();
  readonly #listeners = new AbortController();
  readonly #warned = new Set<string>();
  readonly #attributes: LateAttributes;
  readonly #listAttributes: LateAttributes;
  #viewSensors: readonly { readonly element: AnimatedElement; readonly sensor: ViewSensor }[] = [];
  #movies: readonly { readonly element: AnimatedElement; readonly movie: MovieTexture }[] = [];
  #isInFrame = false;

  constructor(documents: PageDocuments, scene: AnimatedScene, mayStartByItself: boolean) {
    this.#scene = scene;
    this.#documents = documents;
    const write = (changes: Iterable<FieldChange>): void => {
      this.#write(changes);
    };
    this.#attributes = new LateAttributes(write, false);
    this.#listAttributes = new LateAttributes(write, true);
    this.#player = new AnimationPlayer(
      documents,
      {
        now: () => Date.now() / 1000,
        schedule: (callback, delay) => this.#schedule(callback, delay),
      },
      {
        drawnFieldOf: scene.drawnFieldOf,
        apply: (changes) => {
          this.#apply(changes);
        },
        writeAttribute: (element, field, text) => {
          scene.withoutReports(() => {
            element.setAttribute(attributeNameIn(element, field) ?? field, text);
          });
        },
        onEvent: (element, field, type, value) => {
          if (isSequenceFraction(element, field)) scene.showFraction(element, value as number);
          this.#events.send(element, field, type, value);
        },
        warn: (message) => {
          if (this.#warned.has(message)) return;
          this.#warned.add(message);
          scene.warn(message);
        },
      },
      mayStartByItself,
    );
    new PointerSensing(() => documents.roots, this.#player, scene, this.#listeners.signal);
    this.read();
  }

  /** Reads the document's nodes and routes, again after a change. */
  read(): void {
    this.#player.read();
    this.#viewSensors = Array.from(this.#player.nodes).flatMap(([element, { behaviour }]) =>
      behaviour instanceof ViewSensor ? [{ element, sensor: behaviour }] : [],
    );
    this.#movies = Array.from(this.#player.nodes).flatMap(([element, { behaviour }]) =>
      behaviour instanceof MovieTexture ? [{ element, movie: behaviour }] : [],
    );
    for (const element of this.#player.elements) this.#addScriptAccess(element);
    this.onFrame();
  }

  /**
   * A script has set or removed an attribute. Returns whether it concerns nothing that is drawn: it is that of a node of
   * the animation, other than the url of a sequence.
   */
  attributeChanged(element: Element, attribute: string): boolean {
    this.#player.attributeChanged(element, attribute);
    return this.#player.nodes.has(element) && attribute.toLowerCase() !== "url";
  }

  /** Calls back with what each clock moves at its moments, without moving it: see motionMoments.ts. */
  visitMoments(visit: (changes: readonly FieldChange[]) => void): void {
    visitMoments(this.#documents, this.#scene.drawnFieldOf, visit);
  }

  /** Stops all clocks, or lets them go on from where they were. */
  set isPaused(isPaused: boolean) {
    this.#player.isPaused = isPaused;
  }

  /** Whether clocks run that no event has started. */
  set mayStartByItself(mayStart: boolean) {
    this.#player.mayStartByItself = mayStart;
  }

  /** Call after each frame: the view may have changed, and movies may have loaded. */
  onFrame(): void {
    if (this.#movies.length > 0)
      this.#player.run((time) => {
        for (const { element, movie } of this.#movies) movie.setDuration(this.#scene.sequenceDurationOf(element), time);
      });
    if (this.#viewSensors.length === 0) return;
    const view = this.#scene.view();
    if (view === undefined) return;
    this.#player.run((time) => {
      for (const { element, sensor } of this.#viewSensors) {
        const local = this.#localView(view, element);
        if (local) sensor.follow(local, time);
      }
    });
  }

  /** Call before the document is read: writes the attributes of what has moved; readers know the numbers of lists. */
  writeAttributes(): void {
    this.#attributes.writeNow();
  }

  dispose(): void {
    this.#attributes.dispose();
    this.#listAttributes.dispose();
    this.#listeners.abort();
    this.#player.dispose();
  }

  #apply(changes: readonly FieldChange[]): void {
    const read = this.#scene.move(changes);
    const written = read.length > 0 ? new Set(read) : undefined;
    for (const change of changes)
      if (written?.has(change) !== true) (change.type.isList ? this.#listAttributes : this.#attributes).add(change);
    if (written) {
      this.#write(written);
      this.#scene.read(read); // which calls writeAttributes
    }
    if (this.#isInFrame) this.#scene.drawFrame();
    this.#attributes.schedule();
    this.#listAttributes.schedule();
  }

  #write(changes: Iterable<FieldChange>): void {
    this.#scene.withoutReports(() => {
      for (const { element, attribute, type, value } of changes) {
        element.setAttribute(attribute, type.format(value));
        this.#scene.touch(element);
      }
    });
  }

  #localView(view: SceneView, element: AnimatedElement): LocalView | undefined {
    const sceneFromLocal = this.#scene.sceneFromChildrenOf(element.parentElement ?? element);
    const localFromScene = inverseOf(sceneFromLocal);
    if (!localFromScene) return undefined;
    return {
      position: transformPoint(localFromScene, view.position),
      orientation: multiply(rotationIn(localFromScene), view.orientation),
      centerOfRotation: transformPoint(localFromScene, view.centerOfRotation),
      clipFromLocal: product(view.clipFromScene, sceneFromLocal),
    };
  }

  /** A frame for a delay of 0; else a frame after a timer. */
  #schedule(callback: () => void, delay: number): () => void {
    let frame = 0;
    const request = (): void => {
      frame = requestAnimationFrame(() => {
        this.#isInFrame = true;
        try {
          callback();
        } finally {
          this.#isInFrame = false;
        }
      });
    };
    const timer = delay > 0 ? setTimeout(request, 1000 * delay) : undefined;
    if (delay <= 0) request();
    return () => {
      clearTimeout(timer);
      cancelAnimationFrame(frame);
    };
  }

  #addScriptAccess(element: AnimatedElement): void {
    const target = element as AnimatedElement & ScriptAccess;
    if (target.getFieldValue) return;
    addOutputHandler(element);
    target.getFieldValue = (field) => {
      const found = this.#player.fieldOf(element, field);
      return found?.value === undefined ? null : scriptValueOf(found.type, found.value);
    };
    target.setFieldValue = (field, value) => {
      const found = this.#player.fieldOf(element, field);
      const converted = found && valueFromScript(found.type, value);
      if (!found || converted === undefined || !this.#player.setValue(element, found.field, converted))
        this.#scene.warn(`<${element.localName}> setFieldValue("${field}"): no such field, or no value of its type`);
    };
  }
}
