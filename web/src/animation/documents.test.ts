import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { play, routes } from "./animation.testing.ts";

const door = '<Transform DEF="door"/><EXPORT localDEF="door"/>';
const turn = '<PositionInterpolator DEF="turn" key="0 1" keyValue="0 0 0 2 4 6"/>';
const machine = '<Inline DEF="machine"/><IMPORT inlineDEF="machine" importedDEF="door" AS="gate"/>';

describe("a route to a node that a document imports", () => {
  test("moves the node of the inlined document", () => {
    const scene = play(machine + turn + routes("turn.value_changed gate.set_translation"), true, { machine: door });
    scene.set("turn", "set_fraction", "0.5");
    assert.deepEqual(scene.drawn("door", "translation"), [1, 2, 3]);
    assert.deepEqual(scene.warnings, []);
  });

  test("may begin there, under the name that the document exports", () => {
    const scene = play(
      '<Inline DEF="machine"/><IMPORT inlineDEF="machine" importedDEF="way"/><Transform DEF="box"/>' +
        routes("way.value_changed box.translation"),
      true,
      {
        machine: `${turn}<EXPORT localDEF="turn" AS="way"/>${routes("clock.fraction_changed turn.set_fraction")}
        <TimeSensor DEF="clock" loop="true" cycleInterval="4"/>`,
      },
    );
    scene.frameAt(0);
    scene.frameAt(1);
    assert.deepEqual(scene.drawn("box", "translation"), [0.5, 1, 1.5]);
    assert.deepEqual(scene.warnings, []);
  });

  test("may pass through a document between", () => {
    const scene = play(machine + turn + routes("turn.value_changed gate.set_translation"), true, {
      machine:
        '<Inline DEF="inner"/><IMPORT inlineDEF="inner" importedDEF="door" AS="d"/><EXPORT localDEF="d" AS="door"/>',
      inner: door,
    });
    scene.set("turn", "set_fraction", "1");
    assert.deepEqual(scene.drawn("door", "translation"), [2, 4, 6]);
  });

  test("has no effect, without a warning, until the document has loaded", () => {
    const scene = play(machine + turn + routes("turn.value_changed gate.set_translation"));
    scene.set("turn", "set_fraction", "1");
    assert.equal(scene.drawn("door", "translation"), undefined);
    assert.deepEqual(scene.warnings, []);
  });

  const fields = "turn.value_changed gate.set_translation";
  const label = "ROUTE turn.value_changed TO gate.set_translation";
  for (const [what, markup, inlined, fault] of [
    [
      "is not exported",
      machine,
      '<Transform DEF="door"/>',
      'IMPORT "gate": the document of "machine" does not export "door"',
    ],
    ["is exported, but is not there", machine, '<EXPORT localDEF="door"/>', 'no node has DEF="door"'],
    [
      "is of an Inline that is not there",
      '<IMPORT inlineDEF="nothing" importedDEF="door" AS="gate"/>',
      door,
      'IMPORT "gate": no Inline has DEF="nothing"',
    ],
    [
      "exports itself in a circle",
      machine,
      '<Inline DEF="machine"/><IMPORT inlineDEF="machine" importedDEF="door"/><EXPORT localDEF="door"/>',
      'IMPORT "door": the document of "machine" does not export "door"',
    ],
  ] as const)
    test(`that ${what} has no effect, with one sentence, and the rest plays`, () => {
      const scene = play(
        `${markup}${turn}<Transform DEF="box"/>${routes(fields, "turn.value_changed box.translation")}`,
        true,
        {
          machine: inlined,
        },
      );
      scene.set("turn", "set_fraction", "1");
      assert.deepEqual(scene.warnings, [`${label}: ${fault}; the route has no effect`]);
      assert.deepEqual(scene.drawn("box", "translation"), [2, 4, 6]);
    });
});

test("names of inlined documents are their own", () => {
  const scene = play(`${turn}<Transform DEF="door"/>${routes("turn.value_changed door.translation")}`, true, {
    machine: '<Transform DEF="door"/>',
  });
  scene.set("turn", "set_fraction", "1");
  assert.equal(scene.frames, 1);
});
