// X3D's MovieTexture (ISO/IEC 19775-1, 18.4.4) as a clock: of a movie whose images hold the coordinates of a geometry
// (docs/formats/video.md). It sends the fraction of the movie that is shown.

import { sequenceFraction } from "./interpolators.ts";
import type { EventNode } from "./eventNode.ts";
import { inputOnly, inputOutput, nodeType, outputOnly } from "./nodeType.ts";
import type { NodeType } from "./nodeType.ts";
import { TimeSensor } from "./timeSensor.ts";

export class MovieTexture extends TimeSensor {
  readonly #movie: EventNode;
  #duration = 0;

  constructor(node: EventNode) {
    super(node, {
      interval: () => this.#duration / Math.abs(node.numberOf("speed")),
      fraction: (part) => (node.numberOf("speed") < 0 ? 1 - part : part),
    });
    this.#movie = node;
  }

  /** Seconds; 0 until the movie has loaded: it does not play before. */
  setDuration(duration: number, time: number): void {
    if (duration === this.#duration) return;
    this.#duration = duration;
    this.#movie.send("duration_changed", duration);
    this.tick(time);
  }
}

export const movieTexture: NodeType = nodeType(
  {
    enabled: inputOutput("SFBool", true),
    loop: inputOutput("SFBool", false),
    pauseTime: inputOutput("SFTime", 0),
    resumeTime: inputOutput("SFTime", 0),
    speed: inputOutput("SFFloat", 1),
    startTime: inputOutput("SFTime", 0),
    stopTime: inputOutput("SFTime", 0),
    url: inputOutput("MFString", ""),
    set_fraction: inputOnly("SFFloat"),
    cycleTime: outputOnly("SFTime"),
    duration_changed: outputOnly("SFTime"),
    elapsedTime: outputOnly("SFTime"),
    [sequenceFraction]: outputOnly("SFFloat"),
    isActive: outputOnly("SFBool", false),
    isPaused: outputOnly("SFBool", false),
    time: outputOnly("SFTime"),
  },
  (node) => new MovieTexture(node),
);
