// When the frames of a stream appear. Viewers behind a cache request a frame when it is there, so that the cache has it
// for all of them after one request to the server (docs/live.md, "A cache in front").

/** A frame is requested so long after it is due, because its publisher is not punctual. */
const marginMs = 4;
/** How far the schedule follows one frame, in its times and in its interval. */
const timeGain = 0.3;
const intervalGain = 0.02;
/**
 * Clocks are compared again after this time, and after twice the time from then on: the first answers come over
 * connections that are being made, later ones show how the clocks drift apart.
 */
const firstClockLifeMs = 300;
const maxClockLifeMs = 120_000;

/** Times are milliseconds; those of the server are of its clock, all others of the viewer's. */
export class FrameSchedule {
  #intervalMs: number;
  #last: { readonly number: number; readonly addedAt: number } | undefined;
  /** By which the server's clock is ahead of the viewer's. */
  #offsetMs = 0;
  #roundTripMs = Infinity;
  #clockLifeMs = firstClockLifeMs / 2;
  #clockEnd = -Infinity;

  /** `rate`: frames per second that the publisher announces. */
  constructor(rate: number) {
    this.#intervalMs = 1000 / rate;
  }

  /** The server has stated its time in answer to a request. */
  noteClock(serverNow: number, sentAt: number, receivedAt: number): void {
    const roundTripMs = receivedAt - sentAt;
    this.#clockLifeMs = Math.min(2 * this.#clockLifeMs, maxClockLifeMs);
    this.#clockEnd = receivedAt + this.#clockLifeMs;
    // An answer that took long says less than a quick one before, until that is long ago.
    const bound = 1.5 * this.#roundTripMs + 1;
    if (roundTripMs <= bound) this.#offsetMs = serverNow - (sentAt + receivedAt) / 2;
    this.#roundTripMs = Math.min(roundTripMs, bound);
  }

  isClockOld(now: number): boolean {
    return now > this.#clockEnd;
  }

  /** `addedAt`: when the server had the frame, by its clock. */
  noteFrame(number: number, addedAt: number): void {
    const steps = number - (this.#last?.number ?? -1);
    if (steps <= 0) return;
    const expectedAt = this.#last ? this.#last.addedAt + steps * this.#intervalMs : addedAt;
    const lateMs = addedAt - expectedAt;
    // After a break, and a different clock, the schedule begins again.
    const isBreak = Math.abs(lateMs) > this.#intervalMs / 2;
    if (!isBreak) this.#intervalMs += (intervalGain * lateMs) / steps;
    this.#last = { number, addedAt: isBreak ? addedAt : expectedAt + timeGain * lateMs };
  }

  /** When to send the request for a frame, so that the frame is there when the request arrives. */
  requestTimeOf(number: number): number {
    if (this.#last === undefined) return -Infinity;
    const dueAt = this.#last.addedAt + (number - this.#last.number) * this.#intervalMs;
    return dueAt - this.#offsetMs - this.#roundTripMs / 2 + marginMs;
  }

  /** The newest frame whose request is not sent too early now. */
  newestAt(now: number): number {
    if (this.#last === undefined) return -1;
    return this.#last.number + Math.floor((now - this.requestTimeOf(this.#last.number)) / this.#intervalMs);
  }
}
