// X3D's TimeSensor (ISO/IEC 19775-1, 8.2 and 8.4.1): a clock that sends the fraction of its present cycle. Times are in
// seconds.

import type { Behaviour, EventNode } from "./eventNode.ts";
import type { Value } from "./fieldTypes.ts";
import type { NodeType } from "./nodeType.ts";
import { inputOnly, inputOutput, nodeType, outputOnly } from "./nodeType.ts";

/** What a clock's fractions follow from. */
export interface Cycle {
  /** Seconds; infinite: it stands. 0: the clock does not start. */
  readonly interval: () => number;
  /** The fraction that is sent for a part of the interval, 0 … 1. */
  readonly fraction: (part: number) => number;
}

/** Times since 1970 have steps of 2e-7 seconds. */
const roundingError = 1e-6;

export class TimeSensor implements Behaviour {
  readonly #node: EventNode;
  readonly #cycleOf: Cycle;
  /** When the first cycle has begun, later by the time for which it has been paused. */
  #origin = 0;
  #cycle = 0;
  /** When it was paused; undefined while it runs. */
  #pausedAt: number | undefined;
  /** Time for which it has been paused since it became active. */
  #pausedFor = 0;
  #activeSince = 0;
  /** The cycles of an active sensor keep their length. */
  #interval = 1;
  /** The start time with which it has become active last: it does not start twice with the same one. */
  #startUsed: number | undefined;
  #mayStartByItself = true;
  /** Whether an event has started it, or has set `startTime`, `enabled` or `loop` while it was active. */
  #wasStarted = false;
  /** Since when it stands although it is active, as it may not run by itself; undefined while it runs. */
  #heldAt: number | undefined;

  constructor(node: EventNode, cycle?: Cycle) {
    this.#node = node;
    this.#cycleOf = cycle ?? { interval: () => node.numberOf("cycleInterval"), fraction: (part) => part };
  }

  get isActive(): boolean {
    return this.#node.isTrue("isActive");
  }

  /** The duration of a cycle that begins now, in seconds; infinite: it stands, 0: it does not start. */
  get interval(): number {
    return this.#cycleOf.interval();
  }

  /** The fraction that it sends for a part of a cycle, 0 … 1. */
  fractionAt(part: number): number {
    return this.#cycleOf.fraction(part);
  }

  /**
   * Whether it may run as the document says. False if the user prefers reduced motion: then it stands, and goes on from
   * where it was, unless an event has started it.
   */
  setMayStartByItself(mayStart: boolean, time: number): void {
    this.#mayStartByItself = mayStart;
    this.#followRule(time);
  }

  receive(field: string, value: Value, time: number): void {
    switch (field) {
      case "set_fraction": // ours: for scripts, which scrub by it
        this.#node.send("fraction_changed", Math.max(0, Math.min(1, value as number)));
        return;
      case "startTime":
        this.#wasStarted = true;
        if (!this.isActive) this.#startUsed = undefined;
        break;
      case "loop":
      case "enabled":
        this.#wasStarted ||= value === true;
        break;
      default:
    }
    this.#followRule(time);
    this.tick(time);
  }

  get #isHeld(): boolean {
    return this.#heldAt !== undefined;
  }

  #followRule(time: number): void {
    if (this.isActive && !this.#mayStartByItself && !this.#wasStarted) {
      this.#heldAt ??= time;
      return;
    }
    if (this.#heldAt === undefined) return;
    const gap = time - this.#heldAt;
    this.#heldAt = undefined;
    this.#origin += gap;
    this.#pausedFor += gap;
    if (this.#pausedAt !== undefined) this.#pausedAt += gap;
  }

  /** Whether the sensor is to run at this time. */
  #shouldRun(time: number): boolean {
    const node = this.#node;
    if (!node.isTrue("enabled") || time >= this.#stopTime) return false;
    if (this.isActive) return node.isTrue("loop") || time < this.#endOfCycle;
    const [start, interval] = [node.numberOf("startTime"), this.#cycleOf.interval()];
    if (time < start || interval <= 0 || (!this.#mayStartByItself && !this.#wasStarted)) return false;
    return node.isTrue("loop") || (this.#startUsed !== start && time < start + interval);
  }

  /** Infinite where `stopTime` has no effect. */
  get #stopTime(): number {
    const stop = this.#node.numberOf("stopTime");
    const start = this.isActive ? (this.#startUsed ?? 0) : this.#node.numberOf("startTime");
    return stop > start ? stop : Infinity;
  }

  /** Where the sensor stops if it does not loop. */
  get #endOfCycle(): number {
    return this.#pausedAt === undefined && !this.#isHeld ? this.#origin + (this.#cycle + 1) * this.#interval : Infinity;
  }

  tick(time: number): void {
    const node = this.#node;
    if (!this.isActive) {
      if (this.#shouldRun(time)) this.#start(time);
      return;
    }
    if (!this.#shouldRun(time)) {
      this.#stop(time);
      return;
    }
    if (this.#isHeld) return;
    const pause = node.numberOf("pauseTime");
    const resume = node.numberOf("resumeTime");
    const isPaused = pause > 0 && time >= pause && pause > resume;
    if (isPaused && this.#pausedAt === undefined) {
      this.#pausedAt = Math.max(pause, this.#activeSince);
      node.send("isPaused", true);
    } else if (!isPaused && this.#pausedAt !== undefined && time >= resume) {
      const gap = Math.max(0, Math.max(resume, this.#pausedAt) - this.#pausedAt);
      this.#origin += gap;
      this.#pausedFor += gap;
      this.#pausedAt = undefined;
      node.send("isPaused", false);
    }
    if (this.#pausedAt === undefined) this.#sendTime(time);
  }

  nextTick(time: number): number | undefined {
    const node = this.#node;
    if (this.isActive) {
      if (this.#isHeld) return undefined;
      if (this.#pausedAt === undefined) return time;
      const resume = node.numberOf("resumeTime");
      return resume > time ? resume : undefined;
    }
    const start = node.numberOf("startTime");
    if (!node.isTrue("enabled") || (!this.#mayStartByItself && !this.#wasStarted)) return undefined;
    if (start > time) return start;
    return this.#shouldRun(time) ? time : undefined;
  }

  #start(time: number): void {
    const node = this.#node;
    const start = node.numberOf("startTime");
    this.#interval = this.#cycleOf.interval();
    // The default start is long ago: the first cycle begins now.
    this.#origin = start === 0 ? time : start;
    this.#startUsed = start;
    this.#activeSince = time;
    this.#pausedAt = undefined;
    this.#pausedFor = 0;
    this.#cycle = Math.floor((time - this.#origin) / this.#interval);
    node.send("isActive", true);
    node.send("cycleTime", this.#origin + this.#cycle * this.#interval);
    this.#sendTime(time);
  }

  #stop(time: number): void {
    const node = this.#node;
    // The last fraction is the one of the time at which the sensor ends, even if the frame comes later.
    const end = Math.min(this.#stopTime, node.isTrue("loop") ? Infinity : this.#endOfCycle);
    if (node.isTrue("enabled") && this.#pausedAt === undefined && !this.#isHeld)
      this.#sendTime(Math.min(time, end), true);
    if (this.#pausedAt !== undefined) {
      this.#pausedAt = undefined;
      node.send("isPaused", false);
    }
    node.send("isActive", false);
    this.#wasStarted = false;
    this.#heldAt = undefined;
    this.#startUsed = node.numberOf("startTime"); // X3D ignores start times that arrive while the sensor is active
  }

  /** `isLast`: the end of a cycle is its fraction 1, not the next one's 0. */
  #sendTime(time: number, isLast = false): void {
    const node = this.#node;
    const cycles = Math.max(0, time - this.#origin) / this.#interval;
    const whole = Math.floor(cycles);
    const part = cycles - whole;
    if (whole > this.#cycle && !isLast) {
      this.#cycle = whole;
      node.send("cycleTime", this.#origin + whole * this.#interval);
    }
    // A cycle's first instant is the last one of the cycle before, except of the first cycle.
    const fraction = part < roundingError ? (whole === 0 ? 0 : 1) : part;
    node.send("elapsedTime", Math.max(0, time - this.#activeSince - this.#pausedFor));
    node.send("time", time);
    node.send("fraction_changed", this.#cycleOf.fraction(fraction));
  }
}

export const timeSensor: NodeType = nodeType(
  {
    cycleInterval: inputOutput("SFTime", 1),
    enabled: inputOutput("SFBool", true),
    loop: inputOutput("SFBool", false),
    pauseTime: inputOutput("SFTime", 0),
    resumeTime: inputOutput("SFTime", 0),
    startTime: inputOutput("SFTime", 0),
    stopTime: inputOutput("SFTime", 0),
    set_fraction: inputOnly("SFFloat"),
    cycleTime: outputOnly("SFTime"),
    elapsedTime: outputOnly("SFTime"),
    fraction_changed: outputOnly("SFFloat"),
    isActive: outputOnly("SFBool", false),
    isPaused: outputOnly("SFBool", false),
    time: outputOnly("SFTime"),
  },
  (node) => new TimeSensor(node),
);
