import assert from "node:assert/strict";
import { test } from "node:test";
import { play, routes, startOfTests, type TestScene } from "./animation.testing.ts";

const now = startOfTests;

function fractionsOf({ events }: TestScene): number[] {
  return events.filter((event) => event.includes("fraction_changed")).map((event) => Number(event.split(" ")[1]));
}

function assertNear(actual: readonly number[], expected: readonly number[]): void {
  assert.equal(actual.length, expected.length, actual.join(" "));
  actual.forEach((value, i) => {
    assert.ok(Math.abs(value - (expected[i] ?? NaN)) < 1e-6, `${actual.join(" ")} is not ${expected.join(" ")}`);
  });
}

test("a sensor that loops begins with the document, and a cycle ends with the fraction 1", () => {
  const scene = play(`<TimeSensor DEF="t" cycleInterval="4" loop="true"/>`);
  for (const second of [0, 1, 2, 4, 5, 8]) scene.frameAt(second);
  assertNear(fractionsOf(scene), [0, 0.25, 0.5, 1, 0.25, 1]);
  assert.deepEqual(
    scene.events.filter((event) => /isActive|cycleTime/.test(event)),
    ["t.isActive true", `t.cycleTime ${now}`, `t.cycleTime ${now + 4}`, `t.cycleTime ${now + 8}`],
  );
});

test("a sensor that does not loop runs once, sends the fraction 1 and stops", () => {
  const scene = play(`<TimeSensor DEF="t" cycleInterval="2" startTime="${now + 1}"/>`);
  assert.equal(scene.delay, 1, "no frame before the start");
  for (const second of [1, 2, 3.5, 4]) scene.frameAt(second);
  assertNear(fractionsOf(scene), [0, 0.5, 1]);
  assert.equal(scene.events.at(-1), "t.isActive false");
  assert.equal(scene.delay, undefined, "no frame after the end");
});

test("a sensor whose time is over, and one without a cycle, do not start", () => {
  for (const fields of [
    `startTime="0"`,
    `startTime="${now - 9}"`,
    `loop="true" cycleInterval="0"`,
    `loop="true" enabled="false"`,
  ]) {
    const scene = play(`<TimeSensor DEF="t" ${fields}/>`);
    assert.equal(scene.delay, undefined, fields);
    assert.deepEqual(scene.events, []);
  }
});

test("a touch starts a sensor, again after its end", () => {
  const scene = play(
    `<TimeTrigger DEF="touch"/><TimeSensor DEF="t" cycleInterval="2"/>` + routes("touch.triggerTime t.startTime"),
  );
  scene.at(3);
  scene.set("touch", "set_boolean", "true");
  for (const second of [4, 6]) scene.frameAt(second);
  assertNear(fractionsOf(scene), [0, 0.5, 1]);
  scene.at(10);
  scene.set("touch", "set_boolean", "true");
  scene.frameAt(10.5);
  assertNear(fractionsOf(scene), [0, 0.5, 1, 0, 0.25]);
  assert.equal(scene.root.named("t").getAttribute("startTime"), String(now + 10));
});

test("an active sensor ignores start times", () => {
  const scene = play(`<TimeSensor DEF="t" cycleInterval="4" loop="true"/>`);
  scene.frameAt(0);
  scene.frameAt(1);
  scene.set("t", "startTime", String(now + 100));
  scene.frameAt(2);
  assertNear(fractionsOf(scene).slice(-1), [0.5]);
});

test("stopTime stops it, with the fraction of that time", () => {
  const scene = play(`<TimeSensor DEF="t" cycleInterval="4" loop="true"/>`);
  scene.frameAt(0);
  scene.set("t", "stopTime", String(now + 3));
  scene.frameAt(2);
  scene.frameAt(3.5);
  assertNear(fractionsOf(scene).slice(-1), [0.75]);
  assert.equal(scene.events.at(-1), "t.isActive false");
});

test("loop set to false lets the cycle end", () => {
  const scene = play(`<TimeSensor DEF="t" cycleInterval="4" loop="true"/>`);
  for (const second of [0, 5]) scene.frameAt(second);
  scene.set("t", "loop", "false");
  for (const second of [7, 9]) scene.frameAt(second);
  assertNear(fractionsOf(scene).slice(-2), [0.75, 1]);
  assert.equal(scene.events.at(-1), "t.isActive false");
});

test("pauseTime holds the fraction until resumeTime", () => {
  const scene = play(`<TimeSensor DEF="t" cycleInterval="8" loop="true"/>`);
  scene.frameAt(0);
  scene.frameAt(2);
  scene.set("t", "pauseTime", String(now + 2));
  assert.equal(scene.events.at(-1), "t.isPaused true");
  assert.equal(scene.delay, undefined, "no frame while paused");
  scene.at(5);
  scene.set("t", "resumeTime", String(now + 5));
  scene.frameAt(6);
  assertNear(fractionsOf(scene).slice(-1), [3 / 8]);
});

test("a paused scene has no frames, and goes on where it was", () => {
  const scene = play(`<TimeSensor DEF="t" cycleInterval="8" loop="true"/>`);
  scene.frameAt(0);
  scene.frameAt(2);
  scene.player.isPaused = true;
  assert.equal(scene.delay, undefined);
  scene.at(100);
  scene.player.isPaused = false;
  scene.frameAt(101);
  assertNear(fractionsOf(scene).slice(-1), [3 / 8]);
});

test("with reduced motion only what an event starts moves", () => {
  const scene = play(
    `<TimeSensor DEF="loop" loop="true"/><TimeSensor DEF="later" startTime="${now + 1}"/>
     <TimeTrigger DEF="touch"/><TimeSensor DEF="touched" cycleInterval="2"/>` +
      routes("touch.triggerTime touched.startTime"),
    false,
  );
  assert.equal(scene.delay, undefined);
  scene.at(1);
  scene.set("touch", "set_boolean", "true");
  scene.frameAt(2);
  assert.ok(scene.events.every((event) => !event.startsWith("loop") && !event.startsWith("later")));
  assertNear(fractionsOf(scene), [0, 0.5]);
  scene.player.mayStartByItself = true;
  scene.frameAt(2.5);
  assert.ok(scene.events.includes("loop.isActive true"));
});

test("with reduced motion what runs by itself stands, and goes on from there when it may or an event says so", () => {
  const scene = play(
    `<TimeSensor DEF="loop" cycleInterval="10" loop="true"/><TimeSensor DEF="once" cycleInterval="10" startTime="${now}"/>
     <TimeTrigger DEF="touch"/><TimeSensor DEF="touched" cycleInterval="100"/>` +
      routes("touch.triggerTime touched.startTime"),
  );
  const lastOf = (name: string): number =>
    Number(scene.events.findLast((event) => event.startsWith(`${name}.fraction_changed`))?.split(" ")[1]);
  const lasts = (): number[] => ["loop", "once", "touched"].map(lastOf);
  scene.frameAt(0);
  scene.set("touch", "set_boolean", "true");
  scene.frameAt(2);
  assertNear(lasts(), [0.2, 0.2, 0.02]);
  scene.player.mayStartByItself = false;
  scene.frameAt(20);
  assertNear(lasts(), [0.2, 0.2, 0.2]); // a touch has started the third one
  assert.ok(!scene.events.includes("once.isActive false"), "one that stands does not end");
  scene.set("loop", "loop", "true");
  scene.frameAt(21);
  assertNear(lasts(), [0.3, 0.2, 0.21]);
  scene.player.mayStartByItself = true;
  scene.frameAt(22);
  assertNear(lasts(), [0.4, 0.3, 0.22]);
});

test("with reduced motion a page without other clocks draws no frame", () => {
  const scene = play(`<TimeSensor DEF="loop" loop="true"/>`);
  scene.frameAt(0);
  scene.player.mayStartByItself = false;
  assert.equal(scene.delay, undefined);
  assert.equal(scene.player.isMoving, false);
});

test("a script scrubs by the sensor's fraction", () => {
  const scene = play(
    `<TimeSensor DEF="t" enabled="false"/><ScalarInterpolator DEF="i" key="0 1" keyValue="0 10"/><Material DEF="m"/>` +
      routes("t.fraction_changed i.set_fraction", "i.value_changed m.transparency"),
  );
  scene.set("t", "fraction", "0.3");
  assert.equal(scene.drawn("m", "transparency"), 3);
  assert.equal(scene.delay, undefined);
});

test("enabled false stops a sensor at once", () => {
  const scene = play(`<TimeSensor DEF="t" loop="true"/>`);
  scene.frameAt(0);
  scene.set("t", "enabled", "false");
  assert.equal(scene.events.at(-1), "t.isActive false");
  assert.equal(scene.delay, undefined);
});

test("a script starts a sensor by the clock's time, however long the scene has been paused", () => {
  const scene = play(`<TimeSensor DEF="t" cycleInterval="4"/>`);
  scene.player.isPaused = true;
  scene.at(10);
  scene.player.isPaused = false;
  scene.at(11);
  scene.set("t", "startTime", String(now + 11));
  scene.frameAt(12);
  assertNear(fractionsOf(scene), [0, 0.25]);
});
