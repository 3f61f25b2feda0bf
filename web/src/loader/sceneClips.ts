// The animations of a scene as three.js has them: an AnimationClip for each TimeSensor, which an AnimationMixer plays. A
// clip has one track, the seconds since its beginning; the document's routes take them to what moves.

import { AnimationClip, NumberKeyframeTrack, Object3D } from "three";
import { singleDocument } from "../animation/documents.ts";
import type { AnimatedElement } from "../animation/elements.ts";
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

export interface SceneClips {
  /** In document order. */
  readonly clips: readonly AnimationClip[];
  /** To be added to the scene: mixers find what they set by its name. */
  readonly targets: readonly Object3D[];
}

/** `display`: displays values, whose attributes have been written. */
export function sceneClipsOf(
  x3d: AnimatedElement,
  display: (changes: readonly FieldChange[]) => void,
  warn: (message: string) => void,
): SceneClips {
  const player = new AnimationPlayer(
    singleDocument(x3d),
    { now: () => 0, schedule: () => () => undefined }, // no clock runs by itself
    {
      drawnFieldOf,
      apply: (changes) => {
        for (const { element, attribute, type, value } of changes) element.setAttribute(attribute, type.format(value));
        display(changes);
      },
      writeAttribute: () => undefined,
      onEvent: () => undefined,
      warn,
    },
    false,
  );
  player.read();
  const sensors = Array.from(player.nodes).filter(([, { behaviour }]) => behaviour instanceof TimeSensor);
  const made = sensors.map(([element, node], index) => {
    const duration = node.numberOf("cycleInterval");
    const target = new ClipTime(`imgeo-animation-${index}`, (seconds) => {
      player.setValue(element, "set_fraction", Math.max(0, Math.min(1, seconds / duration)));
    });
    const track = new NumberKeyframeTrack(`${target.name}.seconds`, [0, duration], [0, duration]);
    const name = element.getAttribute("DEF") ?? `animation${index}`;
    return { target, clip: new AnimationClip(name, duration, [track]) };
  });
  return { clips: made.map(({ clip }) => clip), targets: made.map(({ target }) => target) };
}
