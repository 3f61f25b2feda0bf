import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { ViewSettings } from "./attributes.ts";
import { readSettings, viewAttributes } from "./attributes.ts";

function settingsOf(attributes: Record<string, string>): { settings: ViewSettings; warnings: string[] } {
  const warnings: string[] = [];
  const element = { getAttribute: (name: string) => attributes[name] ?? null };
  return { settings: readSettings(element, (sentence) => warnings.push(sentence)), warnings };
}

describe("a view's attributes", () => {
  test("have the defaults of the table if they are absent", () => {
    const { settings, warnings } = settingsOf({});
    assert.deepEqual(warnings, []);
    for (const [name, { defaultValue }] of Object.entries(viewAttributes))
      assert.equal(settings[name as keyof ViewSettings], defaultValue, name);
  });

  test("parse camera-orbit as two angles and a length or a percentage, each of which may be auto", () => {
    for (const [text, expected] of [
      ["0deg 75deg 105%", { theta: 0, phi: (75 * Math.PI) / 180, radius: { factor: 1.05 } }],
      [" -0.5rad  1.2rad 250cm ", { theta: -0.5, phi: 1.2, radius: { length: 2.5 } }],
      ["auto 90deg auto", { theta: undefined, phi: Math.PI / 2, radius: undefined }],
      ["auto auto 2e1m", { theta: undefined, phi: undefined, radius: { length: 20 } }],
    ] as const) {
      const { settings, warnings } = settingsOf({ "camera-orbit": text });
      assert.deepEqual([settings["camera-orbit"], warnings], [expected, []], text);
    }
    assert.equal(settingsOf({ "camera-orbit": "auto" }).settings["camera-orbit"], undefined);
  });

  for (const [name, text] of [
    ["camera-orbit", "75deg 105%"],
    ["camera-orbit", "0 75deg 1m"],
    ["camera-orbit", "0deg 75deg -1m"],
    ["camera-orbit", "0deg 75deg 1m 1m"],
    ["camera-orbit", ""],
    ["camera-target", "1m 2m"],
    ["camera-target", "1 2 x"],
    ["field-of-view", "45"],
    ["loading", "soon"],
    ["exposure", "bright"],
    ["auto-rotate-delay", ""],
  ] as const) {
    test(`${name}="${text}" counts as absent, with a warning that names the expected form`, () => {
      const { settings, warnings } = settingsOf({ [name]: text });
      assert.equal(settings[name], viewAttributes[name].defaultValue);
      assert.equal(warnings.length, 1);
      assert.match(warnings[0] ?? "", new RegExp(`^${name}="`));
    });
  }

  test("that are flags are true if present, unless their value is false, off or none", () => {
    for (const [text, expected] of [
      ["", true],
      ["true", true],
      ["camera-controls", true],
      ["false", false],
      ["OFF", false],
      ["none", false],
    ] as const) {
      assert.equal(settingsOf({ "camera-controls": text }).settings["camera-controls"], expected, text);
    }
    assert.equal(settingsOf({ "auto-rotate": "" }).settings["auto-rotate"], true);
  });

  test("parse camera-target as three lengths in metres", () => {
    for (const text of ["1m 0.5m -2m", "1 0.5 -2"]) {
      assert.deepEqual(settingsOf({ "camera-target": text }).settings["camera-target"], [1, 0.5, -2]);
    }
  });
});
