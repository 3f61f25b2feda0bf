// The animations of a scene as three.js has them: an AnimationClip for each TimeSensor and each MovieTexture, which an
// AnimationMixer plays. A clip has one track, the seconds since its beginning; the routes of the document, and of those
// that it inlines, take them to what moves.

import { AnimationClip, NumberKeyframeTrack, Object3D } from "three";
import type { AnimatedDocuments } from "../animation/documents.ts";
import type { AnimatedElement } from "../animation/elements.ts";
import type { EventNode } from "../animation/eventNode.ts";
import { isSequenceFraction } from "../animation/interpolators.ts";
import { MovieTexture } from "../animation/movieTexture.ts";
import { AnimationPlayer } from "../animation/player.ts";
import { TimeSensor } from "../animation/timeSensor.ts";
import type { FieldChange } from "../animation/documentGraph.ts";
import { drawnFieldOf } from "../viewer/drawnFields.ts";

/** Has the property that the track of a clip sets. */
class ClipTime extends Object3D {
  readonly #onTime: (seconds: number) => void;
  /** Before the first time: mixers set only what differs from before, and the first moment of a clip is no rest. */
  #seconds = -1e-9;

  constructor(name: string, onTime: (seconds: number) => void) {
    super();
    this.name = name;
    this.#onTime = onTime;
  }

  get seconds(): number {
    return this.#seconds;
  }

  set seconds(seconds: number) {
    this.#seconds = seconds;
    this.#onTime(seconds);
  }
}

/** What the clips of a scene need of it. */
export interface ClipScene {
  readonly documents: AnimatedDocuments;
  /** Displays values, whose attributes have been written. */
  display(changes: readonly FieldChange[]): void;
  /** An interpolator or a movie with the frames of a sequence has received a fraction, 0 … 1. */
  showFraction(element: AnimatedElement, fraction: number): void;
  /** The duration of the sequence that a movie plays, in seconds; 0 until it is known. */
  sequenceDurationOf(element: AnimatedElement): number;
  warn(message: string): void;
}

/** A clip, and the object whose property it sets: mixers find it in the scene by its name. */
export interface SceneClip {
  readonly clip: AnimationClip;
  readonly target: Object3D;
}

export class SceneClips {
  readonly #scene: ClipScene;
  readonly #player: AnimationPlayer;
  readonly #made = new Set<EventNode>();
  readonly #warned = new Set<string>();

  constructor(scene: ClipScene) {
    this.#scene = scene;
    this.#player = new AnimationPlayer(
      scene.documents,
      { now: () => 0, schedule: () => () => undefined }, // no clock runs by itself
      {
        drawnFieldOf,
        apply: (changes) => {
          for (const { element, attribute, type, value } of changes)
            element.setAttribute(attribute, type.format(value));
          scene.display(changes);
        },
        writeAttribute: () => undefined,
        onEvent: (element, field, _, value) => {
          if (isSequenceFraction(element, field)) scene.showFraction(element, value as number);
        },
        warn: (message) => {
          if (this.#warned.has(message)) return;
          this.#warned.add(message);
          scene.warn(message);
        },
      },
      false,
    );
  }

  /** Reads the documents, again where another one has been inlined. Returns clips that are new, in document order. */
  read(): readonly SceneClip[] {
    this.#player.read();
    return this.takeNew();
  }

  /** The clips of movies whose durations have become known since the last call. */
  takeNew(): readonly SceneClip[] {
    const clips: SceneClip[] = [];
    for (const [element, node] of this.#player.nodes) {
      const { behaviour } = node;
      if (!(behaviour instanceof TimeSensor) || this.#made.has(node)) continue;
      if (behaviour instanceof MovieTexture) {
        const duration = this.#scene.sequenceDurationOf(element);
        this.#player.run((time) => {
          behaviour.setDuration(duration, time);
        });
      }
      const duration = behaviour.interval;
      if (!(duration > 0 && duration < Infinity)) continue;
      clips.push(this.#clipOf(element, behaviour, duration));
      this.#made.add(node);
    }
    return clips;
  }

  #clipOf(element: AnimatedElement, sensor: TimeSensor, duration: number): SceneClip {
    const index = this.#made.size;
    const target = new ClipTime(`imgeo-animation-${index}`, (seconds) => {
      const part = Math.max(0, Math.min(1, seconds / duration));
      this.#player.setValue(element, "set_fraction", sensor.fractionAt(part));
    });
    const track = new NumberKeyframeTrack(`${target.name}.seconds`, [0, duration], [0, duration]);
    const name = element.getAttribute("DEF") ?? `animation${index}`;
    return { target, clip: new AnimationClip(name, duration, [track]) };
  }
}
