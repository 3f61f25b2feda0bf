import assert from "node:assert/strict";
import { test } from "node:test";
import { play, routes, startOfTests } from "./animation.testing.ts";

test("an event goes through all routes with one time", () => {
  const scene = play(
    `<TouchSensor DEF="touch"/><BooleanToggle DEF="toggle"/><BooleanFilter DEF="filter"/><TimeTrigger DEF="when"/>
     <IntegerTrigger DEF="which" integerKey="3"/><Switch DEF="switch"/><PointLight DEF="lamp"/>` +
      routes(
        "toggle.toggle filter.set_boolean",
        "filter.inputNegate lamp.on",
        "filter.inputTrue when.set_boolean",
        "filter.inputTrue which.set_boolean",
        "which.triggerValue switch.whichChoice",
      ),
  );
  scene.at(5);
  scene.set("toggle", "set_boolean", "true");
  assert.deepEqual(scene.events, [
    "toggle.toggle true",
    "filter.inputTrue true",
    "filter.inputNegate false",
    `when.triggerTime ${startOfTests + 5}`,
    "which.triggerValue 3",
  ]);
  assert.equal(scene.drawn("lamp", "on"), false);
  assert.equal(scene.drawn("switch", "whichChoice"), 3);
  assert.equal(scene.frames, 1, "what one event changes is handed on at once");
  assert.equal(scene.root.named("toggle").getAttribute("toggle"), "true", "the attribute follows the field");
});

test("routes in circles end", () => {
  const scene = play(
    `<BooleanFilter DEF="a"/><BooleanFilter DEF="b"/>` +
      routes("a.inputNegate b.set_boolean", "b.inputNegate a.set_boolean"),
  );
  scene.set("a", "set_boolean", "true");
  assert.deepEqual(scene.events, [
    "a.inputTrue true",
    "a.inputNegate false",
    "b.inputFalse false",
    "b.inputNegate true",
  ]);
  assert.deepEqual(scene.warnings, [
    '<BooleanFilter DEF="a"> inputNegate: ROUTEs lead back to it; an event goes around this circle once',
  ]);
});

test("a scene with routes in a circle plays, and says so in one sentence", () => {
  const scene = play(
    `<TimeSensor DEF="clock" loop="true" cycleInterval="4"/><Transform DEF="a"/><Transform DEF="b"/><Transform DEF="c"/>
     <PositionInterpolator DEF="move" key="0 1" keyValue="0 0 0  4 0 0"/>` +
      routes(
        "clock.fraction_changed move.set_fraction",
        "move.value_changed a.set_translation",
        "a.translation_changed b.set_translation",
        "b.translation_changed c.set_translation",
        "c.translation_changed a.set_translation",
      ),
  );
  scene.frameAt(0);
  for (const seconds of [1, 3]) {
    scene.frameAt(seconds);
    for (const name of ["a", "b", "c"]) assert.deepEqual(scene.drawn(name, "translation"), [seconds, 0, 0]);
  }
  assert.deepEqual(scene.warnings, [
    '<Transform DEF="a"> translation: ROUTEs lead back to it; an event goes around this circle once',
  ]);
});

test("routes that meet again, and a clock whose events come back to it, are no circles", () => {
  const scene = play(
    `<TimeSensor DEF="clock"/><BooleanFilter DEF="f"/><BooleanToggle DEF="t"/><Transform DEF="a"/><Transform DEF="b"/>` +
      routes(
        "clock.isActive f.set_boolean",
        "f.inputTrue t.set_boolean",
        "f.inputFalse t.set_boolean",
        "t.toggle clock.enabled",
        "clock.stopTime clock.startTime",
        "a.translation b.translation",
      ),
  );
  assert.deepEqual(scene.warnings, []);
});

test("two transforms that follow each other have the same translation", () => {
  const scene = play(
    `<Transform DEF="a"/><Transform DEF="b"/>` +
      routes("a.translation_changed b.set_translation", "b.translation_changed a.set_translation"),
  );
  scene.set("a", "translation", "1 2 3");
  assert.deepEqual(scene.drawn("b", "translation"), [1, 2, 3]);
  scene.set("b", "translation", "4 5 6");
  assert.deepEqual(scene.drawn("a", "translation"), [4, 5, 6]);
});

test("one output feeds many inputs, and one input has many sources", () => {
  const scene = play(
    `<ScalarInterpolator DEF="a" key="0 1" keyValue="0 1"/><ScalarInterpolator DEF="b" key="0 1" keyValue="5 6"/>
     <Material DEF="m"/><Material DEF="n"/>` +
      routes("a.value_changed m.transparency", "a.value_changed n.transparency", "b.value_changed m.transparency"),
  );
  scene.set("a", "set_fraction", "0.5");
  assert.deepEqual([scene.drawn("m", "transparency"), scene.drawn("n", "transparency")], [0.5, 0.5]);
  scene.set("b", "fraction", "0.5");
  assert.deepEqual([scene.drawn("m", "transparency"), scene.drawn("n", "transparency")], [5.5, 0.5]);
});

test("routes that lead nowhere are one sentence each, and the others work", () => {
  const scene = play(
    `<ScalarInterpolator DEF="a" key="0 1" keyValue="0 1"/><Material DEF="m"/><Transform DEF="t"/>` +
      routes(
        "nobody.value_changed m.transparency",
        "a.value_changed nobody.transparency",
        "a.value m.transparancy",
        "a.nothing m.transparency",
        "a.value_changed t.translation",
        "a.set_fraction m.transparency",
        "a.value_changed m.transparency",
        "a.value_changed m.transparency",
      ),
  );
  assert.deepEqual(scene.warnings, [
    `ROUTE nobody.value_changed TO m.transparency: no node has DEF="nobody"; the route has no effect`,
    `ROUTE a.value_changed TO nobody.transparency: no node has DEF="nobody"; the route has no effect`,
    `ROUTE a.value TO m.transparancy: <Material DEF="m"> has no input transparancy; the route has no effect`,
    `ROUTE a.nothing TO m.transparency: <ScalarInterpolator DEF="a"> has no output nothing; the route has no effect`,
    `ROUTE a.value_changed TO t.translation: SFFloat is no SFVec3f; the route has no effect`,
    `ROUTE a.set_fraction TO m.transparency: <ScalarInterpolator DEF="a"> has no output set_fraction; the route has no effect`,
  ]);
  scene.set("a", "set_fraction", "0.25");
  assert.equal(scene.drawn("m", "transparency"), 0.25);
});

test("sequencers send the value of the last key, when it is another one", () => {
  const scene = play(
    `<IntegerSequencer DEF="it" key="0 0.5 0.8" keyValue="7 8 9"/><Switch DEF="s"/>` +
      routes("it.value_changed s.whichChoice"),
  );
  for (const fraction of ["0", "0.4", "0.5", "0.79", "0.9", "1", "0.1"]) scene.set("it", "set_fraction", fraction);
  assert.deepEqual(
    scene.events.map((event) => event.split(" ")[1]),
    ["7", "8", "9", "7"],
  );
  for (const input of ["next", "previous", "previous"]) scene.set("it", input, "true");
  assert.deepEqual(
    scene.events.slice(4).map((event) => event.split(" ")[1]),
    ["8", "7", "9"],
  );
});

test("a boolean sequencer sends booleans", () => {
  const scene = play(`<BooleanSequencer DEF="it" key="0 0.5" keyValue="false TRUE"/>`);
  for (const fraction of ["0.2", "0.7"]) scene.set("it", "set_fraction", fraction);
  assert.deepEqual(scene.events, ["it.value_changed false", "it.value_changed true"]);
});

test("a route that a script adds counts from the next event on, and nodes keep their state", () => {
  const scene = play(`<BooleanToggle DEF="a"/><PointLight DEF="lamp"/>`);
  scene.set("a", "set_boolean", "true");
  const [route] = routes("a.toggle lamp.on").matchAll(/(\w+)="(\w+)"/g);
  assert.ok(route);
  const element = play(routes("a.toggle lamp.on")).root.children[0];
  assert.ok(element);
  scene.root.children.push(element);
  scene.player.read();
  scene.set("a", "set_boolean", "true");
  assert.equal(scene.drawn("lamp", "on"), false, "the toggle was true before");
});

test("a route from a list of numbers to geometry is one of lists", () => {
  const scene = play(
    `<CoordinateInterpolator DEF="a" key="0 1" keyValue="0 0 0  2 2 2"/><Coordinate DEF="c"/>` +
      routes("a.value_changed c.set_point"),
  );
  scene.set("a", "set_fraction", "0.5");
  assert.deepEqual(scene.drawn("c", "point"), [1, 1, 1]);
});
