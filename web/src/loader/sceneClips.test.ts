import assert from "node:assert/strict";
import { test } from "node:test";
import { AnimationMixer, Group } from "three";
import { routes, sceneOf, type TestElement } from "../animation/animation.testing.ts";
import type { FieldChange } from "../animation/documentGraph.ts";
import type { SceneClip } from "./sceneClips.ts";
import { SceneClips } from "./sceneClips.ts";

/** The clips of a document that inlines another one, in an app's scene. */
function appOf(markup: string, inlinedMarkup = "") {
  const [root, inlinedRoot] = [sceneOf(markup), sceneOf(inlinedMarkup)];
  const changes: FieldChange[] = [];
  const fractions: [string | null, number][] = [];
  const warnings: string[] = [];
  const durations = new Map<string, number>();
  const scene = new Group();
  let hasLoaded = false;
  const clips = new SceneClips({
    documents: {
      get roots(): readonly TestElement[] {
        return hasLoaded ? [root, inlinedRoot] : [root];
      },
      documentOf: () => (hasLoaded ? inlinedRoot : undefined),
    },
    display: (displayed) => changes.push(...displayed),
    showFraction: (element, fraction) => fractions.push([element.getAttribute("DEF"), fraction]),
    sequenceDurationOf: (element) => durations.get(element.getAttribute("DEF") ?? "") ?? 0,
    warn: (message) => warnings.push(message),
  });
  const add = (made: readonly SceneClip[]): string[] => {
    for (const { clip, target } of made) {
      scene.animations.push(clip);
      scene.add(target);
    }
    return made.map(({ clip }) => `${clip.name} ${clip.duration}`);
  };
  return {
    root,
    inlinedRoot,
    fractions,
    warnings,
    first: add(clips.read()),
    load: () => {
      hasLoaded = true;
      return add(clips.read());
    },
    know: (name: string, duration: number) => {
      durations.set(name, duration);
      return add(clips.takeNew());
    },
    show: (name: string, seconds: number) => {
      const mixer = new AnimationMixer(scene);
      const clip = scene.animations.find((each) => each.name === name);
      assert.ok(clip, name);
      mixer.clipAction(clip).play();
      mixer.setTime(seconds);
    },
    changed: () => changes.splice(0).map(({ element, field, value }) => [element.getAttribute("DEF"), field, value]),
  };
}

const move = `<PositionInterpolator DEF="move" key="0 1" keyValue="0 0 0 8 0 0"/>`;

test("a clip moves what an inlined document exports, once that has loaded", () => {
  const app = appOf(
    `<TimeSensor DEF="clock" cycleInterval="4"/>${move}<Inline DEF="machine" url="machine.x3d"/>
     <IMPORT inlineDEF="machine" importedDEF="arm" AS="crane"/>` +
      routes("clock.fraction_changed move.set_fraction", "move.value_changed crane.translation"),
    `<Transform DEF="arm"/><TimeSensor DEF="inner" cycleInterval="2"/><EXPORT localDEF="arm"/>`,
  );
  assert.deepEqual(app.first, ["clock 4"]);
  assert.deepEqual(app.load(), ["inner 2"], "the clocks of an inlined document are clips, too");
  app.show("clock", 1);
  assert.deepEqual(app.changed(), [["arm", "translation", [2, 0, 0]]]);
  assert.equal(app.inlinedRoot.named("arm").getAttribute("translation"), "2 0 0");
  assert.deepEqual(app.warnings, []);
});

test("an import of what is not exported is one warning, however often the documents are read", () => {
  const app = appOf(
    `<TimeSensor DEF="clock"/>${move}<Inline DEF="machine" url="machine.x3d"/>
     <IMPORT inlineDEF="machine" importedDEF="arm"/>` +
      routes("clock.fraction_changed move.set_fraction", "move.value_changed arm.translation"),
    `<Transform DEF="arm"/>`,
  );
  app.load();
  app.load();
  assert.equal(app.warnings.length, 1, app.warnings.join());
});

test("a clip plays the sequence that its clock drives", () => {
  const app = appOf(
    `<TimeSensor DEF="clock" cycleInterval="4"/><CoordinateInterpolator DEF="frames" url="frames.json"/>` +
      routes("clock.fraction_changed frames.set_fraction"),
  );
  app.show("clock", 3);
  assert.deepEqual(app.fractions, [["frames", 0.75]]);
});

test("a movie is a clip as soon as its duration is known, in its own speed and direction", () => {
  const app = appOf(
    `<MovieTexture DEF="forth" url="a.webm a.json" loop="true"/><MovieTexture DEF="back" speed="-2" url="a.webm a.json"/>
     <MovieTexture DEF="still" speed="0" url="a.webm a.json"/>`,
  );
  assert.deepEqual(app.first, []);
  assert.deepEqual(app.know("forth", 10), ["forth 10"]);
  assert.deepEqual(app.know("back", 10), ["back 5"]);
  assert.deepEqual(app.know("still", 10), []);
  app.fractions.length = 0;
  app.show("forth", 2.5);
  app.show("back", 1);
  assert.deepEqual(app.fractions, [
    ["forth", 0.25],
    ["back", 0.8],
  ]);
});
