// Pulls the newest frames of a live stream (docs/live.md): two requests are outstanding, frames that are late are
// skipped and never queued, and whatever fails is tried again.

import { DecodeError } from "../../decode/decodeError.ts";
import type { FrameHeader } from "../../decode/frame/frameHeader.ts";
import { frameHeaderBytes, maxUnpackedBytes } from "../../decode/frame/frameHeader.ts";
import type { AttemptListener } from "../../scheduler/download.ts";
import { download, RequestError } from "../../scheduler/download.ts";
import { FrameSchedule } from "./frameSchedule.ts";
import type { DecodedFrame } from "./frameTarget.ts";
import type { StreamState } from "./streamState.ts";
import { readStreamState } from "./streamState.ts";

export interface FrameSourceOptions {
  /** The stream's, absolute, without "/latest"; its query, which may hold a token, is that of every request. */
  readonly url: string;
  readonly fetch: typeof fetch;
  /** Decodes a frame in a worker. Rejects with DecodeError, or with the signal's reason. */
  readonly decode: (bytes: Uint8Array<ArrayBuffer>, signal: AbortSignal) => Promise<DecodedFrame>;
  /** Milliseconds of a clock that never runs backwards. */
  readonly now: () => number;
  /** Resolves after the given time, or rejects with the signal's reason. */
  readonly delay: (ms: number, signal: AbortSignal) => Promise<void>;
}

export interface FrameSourceListener {
  /** Called before the first frame and before that of another epoch. */
  onEpoch(state: StreamState): void;
  /** A frame newer than all before. `skipped`: the number of frames between it and the one before. */
  onFrame(frame: DecodedFrame, skipped: number, byteLength: number): void;
  /** No frame can be had. Called once until the next frame; the source tries on by itself. */
  onOutage(error: Error): void;
}

/** Requests that wait for frames at the same time: with one, a frame in two would be missed on a slow line. */
const outstanding = 2;
/** After a failure `latest` is read again after this time, and after twice the time from failure to failure. */
const firstPauseMs = 1000;
const maxPauseMs = 15_000;
/** A request that brings no answer, or no further byte, for this long has failed. The server answers after 10 s. */
const idleMs = 20_000;
/** A viewer that is further behind, by the publisher's rate, asks `latest` how far. */
const maxFramesBehind = 3;
const maxStateBytes = 2 ** 16;
/** Larger than any frame: deflate makes incompressible bytes hardly longer. */
const maxFrameBytes = frameHeaderBytes + 2 * maxUnpackedBytes;

/** `latest` is to be read again, at once where the stream has another epoch. Nothing is wrong. */
class StateIsOld extends Error {
  readonly isUrgent: boolean;

  constructor(isUrgent: boolean) {
    super();
    this.isUrgent = isUrgent;
  }
}

export class FrameSource {
  readonly #options: FrameSourceOptions;
  readonly #listener: FrameSourceListener;
  #running: AbortController | undefined;
  #rate = 0;
  #epoch: number | undefined;
  /** The number of the frame that the listener has received last. */
  #shown = -1;
  #isOut = false;
  /** The newest number that is known to have existed at a time. */
  #newest = { number: 0, at: 0 };
  /** Where a cache shares frames among viewers: when they appear. */
  #schedule: FrameSchedule | undefined;

  constructor(options: FrameSourceOptions, listener: FrameSourceListener) {
    this.#options = options;
    this.#listener = listener;
  }

  get isRunning(): boolean {
    return this.#running !== undefined;
  }

  /** Begins to request frames. */
  start(): void {
    if (this.#running !== undefined) return;
    const aborter = (this.#running = new AbortController());
    void this.#run(aborter.signal);
  }

  /** Aborts all requests. */
  stop(): void {
    this.#running?.abort();
    this.#running = undefined;
  }

  /** Sets the largest number of frames that are requested per second; 0: all. */
  setRate(rate: number): void {
    if (rate === this.#rate) return;
    this.#rate = rate;
    if (!this.isRunning) return;
    this.stop();
    this.start();
  }

  async #run(signal: AbortSignal): Promise<void> {
    let pauseMs = firstPauseMs / 2;
    let isUrgent = false;
    for (;;) {
      const shownBefore = this.#shown;
      try {
        const state = await this.#readState(signal);
        await this.#pull(state, signal);
      } catch (error) {
        if (signal.aborted) return;
        // A server whose "latest" and frames never agree is not asked all the time.
        const wasUrgent: boolean = isUrgent && this.#shown === shownBefore;
        isUrgent = error instanceof StateIsOld && error.isUrgent && !wasUrgent;
        if (isUrgent) continue;
        if (wasUrgent) this.#report(new DecodeError("malformed", 'has frames of another epoch than "latest" states'));
        else if (!(error instanceof StateIsOld)) this.#report(error);
      }
      pauseMs = this.#shown === shownBefore ? Math.min(2 * pauseMs, maxPauseMs) : firstPauseMs;
      // Viewers that lost the same server do not return at the same moment.
      await this.#options.delay(pauseMs * (1 + Math.random() / 2), signal).catch(() => undefined);
      if (isAborted(signal)) return;
    }
  }

  #report(error: unknown): void {
    if (this.#isOut) return;
    this.#isOut = true;
    this.#listener.onOutage(error instanceof Error ? error : new Error(String(error)));
  }

  async #readState(signal: AbortSignal): Promise<StreamState> {
    const sentAt = this.#options.now();
    const bytes = await this.#get("/latest", maxStateBytes, signal);
    const state = readStreamState(new TextDecoder().decode(bytes));
    if (state.hasEnded) throw new RequestError("http", this.#options.url, "the stream has ended", 404);
    if (state.epoch !== this.#epoch) {
      this.#epoch = state.epoch;
      this.#schedule = undefined;
      this.#shown = Math.min(this.#shown, state.epoch - 1); // a server may have lost its clock
      this.#listener.onEpoch(state);
    }
    this.#newest = { number: state.number ?? state.next - 1, at: this.#options.now() };
    if (state.isTimed && state.rate > 0) {
      this.#schedule ??= new FrameSchedule(state.rate);
      this.#schedule.noteClock(state.now, sentAt, this.#newest.at);
      if (state.number !== undefined && state.addedAt !== undefined)
        this.#schedule.noteFrame(state.number, state.addedAt);
    }
    return state;
  }

  /** Requests frames until one request fails; then aborts the others and rejects with the failure. */
  async #pull(state: StreamState, signal: AbortSignal): Promise<void> {
    const lanes = new AbortController();
    const all = AbortSignal.any([signal, lanes.signal]);
    // Until an epoch has its first frame, the newest one is of the epoch before.
    let requested = Math.max(this.#shown, state.epoch - 1, (state.number ?? state.next) - 1);
    // While a frame was on its way over a slow line, others have appeared.
    const takeNumber = () =>
      (requested = Math.max(requested + 1, this.#schedule?.newestAt(this.#options.now()) ?? this.#newest.number));
    const lane = async () => {
      for (;;) {
        const number = takeNumber();
        await this.#delayUntil(this.#schedule?.requestTimeOf(number), all);
        await this.#requestFrame(number, state, all);
        if (this.#isBehind(number, state)) await this.#readStateOf(state, all);
      }
    };
    try {
      if (this.#rate > 0) await this.#pullSlowly(takeNumber, state, all);
      else await Promise.all(Array.from({ length: outstanding }, lane));
    } finally {
      lanes.abort();
    }
  }

  /** Requests a frame, the newest then, at most `rate` times a second. */
  async #pullSlowly(takeNumber: () => number, state: StreamState, signal: AbortSignal): Promise<void> {
    for (;;) {
      const due = this.#options.now() + 1000 / this.#rate;
      await this.#requestFrame(takeNumber(), state, signal);
      await this.#delayUntil(due, signal);
      if (this.#schedule?.isClockOld(this.#options.now()) ?? true) await this.#readStateOf(state, signal);
    }
  }

  async #delayUntil(time: number | undefined, signal: AbortSignal): Promise<void> {
    const ms = time === undefined ? 0 : time - this.#options.now();
    if (ms > 0) await this.#options.delay(ms, signal);
  }

  /** Whether `latest` is to be read again after this frame, to learn the newest number or the server's time. */
  #isBehind(number: number, state: StreamState): boolean {
    if (this.#schedule) return this.#schedule.isClockOld(this.#options.now());
    return number + maxFramesBehind < this.#expectedNewest(state);
  }

  /** Learns the newest number. */
  async #readStateOf({ epoch }: StreamState, signal: AbortSignal): Promise<void> {
    if ((await this.#readState(signal)).epoch !== epoch) throw new StateIsOld(true);
  }

  /** The newest number by the publisher's rate. */
  #expectedNewest({ rate }: StreamState): number {
    return this.#newest.number + ((this.#options.now() - this.#newest.at) * rate) / 1000;
  }

  /**
   * Notes what the head of a response tells: a frame that the server has waited for is the newest one. `Imgeo-Newest`
   * of a response that a cache has kept may be too small.
   */
  #noteNewest(state: StreamState, number: number, requestedAt: number, stated: number): void {
    const now = this.#options.now();
    const hasWaited = now - requestedAt > 500 / (state.rate || 30);
    const newest = hasWaited ? Math.max(number, stated) : stated;
    if (hasWaited || newest > this.#expectedNewest(state)) this.#newest = { number: newest, at: now };
  }

  async #requestFrame(requested: number, state: StreamState, signal: AbortSignal): Promise<void> {
    const requestedAt = this.#options.now();
    let addedAt = NaN;
    const bytes = await this.#get(`/frames/${requested}`, maxFrameBytes, signal, {
      onHeaders: (headers) => {
        this.#noteNewest(state, requested, requestedAt, Number(headers.get("imgeo-newest") ?? 0));
        addedAt = Number(headers.get("imgeo-added") ?? NaN);
      },
    });
    const byteLength = bytes.byteLength;
    const frame = await this.#options.decode(bytes, signal);
    signal.throwIfAborted();
    const { header } = frame;
    const { number } = header;
    // A later one: the server has led from a frame that is gone to the newest one.
    if (number < requested) throw new DecodeError("malformed", `is frame ${number} and not ${requested}`);
    if (!Number.isNaN(addedAt)) this.#schedule?.noteFrame(number, addedAt);
    if (header.epoch !== state.epoch) throw new StateIsOld(true);
    if (!isSameLayout(header, state))
      throw new DecodeError("malformed", `has other vertices than "latest" states for epoch ${state.epoch}`);
    if (number <= this.#shown) return; // the other request was faster
    const skipped = this.#shown < 0 ? 0 : number - this.#shown - 1;
    this.#shown = number;
    this.#isOut = false;
    this.#listener.onFrame(frame, skipped, byteLength);
  }

  async #get(
    path: string,
    maxBytes: number,
    signal: AbortSignal,
    listener: AttemptListener = {},
  ): Promise<Uint8Array<ArrayBuffer>> {
    const [stream = "", query] = this.#options.url.split("?");
    const url = `${stream}${path}${query === undefined ? "" : `?${query}`}`;
    try {
      return await download(url, signal, { fetch: this.#options.fetch, idleTimeoutMs: idleMs, maxBytes }, listener);
    } catch (error) {
      throw error instanceof RequestError ? failureOf(error, path !== "/latest") : error;
    }
  }
}

/** A function, because the type checker takes a property for what it was before an `await`. */
function isAborted(signal: AbortSignal): boolean {
  return signal.aborted;
}

function failureOf(error: RequestError, isFrame: boolean): Error {
  const { status, url } = error;
  if (isFrame && (status === 404 || status === 410)) return new StateIsOld(false); // it is too new, or gone
  return status === 503 ? new RequestError("timeout", url, "the publisher sends no frames", status) : error;
}

function isSameLayout(a: FrameHeader, b: StreamState): boolean {
  return (
    a.vertices === b.vertices &&
    a.columns === b.columns &&
    a.positionBits === b.positionBits &&
    a.normalBits === b.normalBits &&
    a.colorComponents === b.colorComponents &&
    a.valueComponents === b.valueComponents &&
    a.valueBits === b.valueBits
  );
}
