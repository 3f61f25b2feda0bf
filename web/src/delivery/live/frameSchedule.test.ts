import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { FrameSchedule } from "./frameSchedule.ts";

const rate = 30;
const intervalMs = 1000 / rate;
const serverClockMs = 1e12;
/** Frames appear at 1000, 1033 ... of the viewer's clock. */
const timeOf = (number: number, everyMs = intervalMs) => 1000 + number * everyMs;

function synchronised(): FrameSchedule {
  const schedule = new FrameSchedule(rate);
  schedule.noteClock(serverClockMs + 500, 495, 505);
  return schedule;
}

/** How late the request for the next frame arrives at the server, which is 5 ms away, after `count` frames. */
function latenessAfter(count: number, everyMs: number, jitter: (number: number) => number = () => 0): number {
  const schedule = synchronised();
  for (let number = 0; number < count; ++number)
    schedule.noteFrame(number, serverClockMs + timeOf(number, everyMs) + jitter(number));
  return schedule.requestTimeOf(count) + 5 - timeOf(count, everyMs);
}

describe("FrameSchedule", () => {
  it("has requests arrive just after frames are due", () => {
    assert.ok(Math.abs(latenessAfter(1, intervalMs) - 4) < 0.01);
    assert.ok(Math.abs(latenessAfter(100, intervalMs) - 4) < 0.01);
  });

  it("follows publishers who are faster or slower than they announce, and not punctual", () => {
    for (const everyMs of [0.97 * intervalMs, 1.05 * intervalMs])
      assert.ok(Math.abs(latenessAfter(300, everyMs) - 4) < 1, `${latenessAfter(300, everyMs)} ms`);
    const lateness = latenessAfter(300, intervalMs, (number) => 4 * Math.sin(number * number));
    assert.ok(lateness > 0 && lateness < 8, `${lateness} ms`);
  });

  it("begins again after a break", () => {
    const schedule = synchronised();
    schedule.noteFrame(1, serverClockMs + 1000);
    schedule.noteFrame(2, serverClockMs + 5000);
    assert.ok(Math.abs(schedule.requestTimeOf(3) + 5 - (5000 + intervalMs + 4)) < 0.01);
  });

  it("knows the newest frame without a request", () => {
    const schedule = synchronised();
    assert.equal(schedule.newestAt(700), -1);
    schedule.noteFrame(7, serverClockMs + 1000);
    assert.equal(schedule.newestAt(1000 + 10), 7);
    assert.equal(schedule.newestAt(1000 + 10 + 3 * intervalMs), 10);
  });

  it("trusts the quickest answer about the server's clock, and compares again", () => {
    const schedule = new FrameSchedule(rate);
    assert.ok(schedule.isClockOld(0));
    schedule.noteClock(serverClockMs + 500, 300, 510); // a connection was made first
    schedule.noteFrame(0, serverClockMs + 1000);
    assert.ok(schedule.requestTimeOf(0) < 950);
    schedule.noteClock(serverClockMs + 600, 595, 605);
    assert.ok(Math.abs(schedule.requestTimeOf(0) - 999) < 0.01);
    schedule.noteClock(serverClockMs + 700, 600, 705); // it waited behind a frame
    assert.ok(schedule.requestTimeOf(0) > 995);
    assert.ok(!schedule.isClockOld(900) && schedule.isClockOld(3000));
  });
});
