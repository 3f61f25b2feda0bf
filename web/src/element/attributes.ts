// The settings of a view as attributes of <x3d>: one table of names, value types and
// defaults, after the conventions of <model-viewer>. A malformed attribute counts as
// absent, with a warning on the console.

import type { CameraSetting, OrbitSetting, RadiusSetting } from "../navigation/orbit.ts";

interface ValueType<Value> {
  /** The expected form, for the warning. */
  readonly form: string;
  /** Undefined: malformed. */
  parse(text: string): Value | undefined;
}

interface Attribute<Value> {
  readonly type: ValueType<Value>;
  readonly defaultValue: Value;
}

const anyText: ValueType<string> = { form: "a text", parse: (text) => text };

/** A boolean attribute; "false", "off" and "none" count as absent, because frameworks write them. */
const flag: ValueType<boolean> = { form: "a flag", parse: (text) => !/^(false|off|none)$/i.test(text.trim()) };

const number: ValueType<number> = {
  form: "a number",
  parse: (text) => (text.trim() !== "" && Number.isFinite(Number(text)) ? Number(text) : undefined),
};

/** Parses to bytes. */
const megabytes: ValueType<number> = {
  form: "a number of megabytes",
  parse: (text) => (text.trim() !== "" && Number(text) >= 0 ? Number(text) * 1e6 : undefined),
};

function oneOf<const Word extends string>(...words: readonly Word[]): ValueType<Word> {
  return {
    form: `one of ${words.join(", ")}`,
    parse: (text) => words.find((word) => word === text.trim().toLowerCase()),
  };
}

/** An angle with its unit; parses to radians. */
const angle: ValueType<number> = {
  form: "an angle such as 45deg or 0.8rad",
  parse(text) {
    const [, value, unit] = /^([-+]?[\d.]+(?:e[-+]?\d+)?)(deg|rad)$/i.exec(text.trim()) ?? [];
    const radians = Number(value) * (unit?.toLowerCase() === "deg" ? Math.PI / 180 : 1);
    return Number.isFinite(radians) ? radians : undefined;
  },
};

const radius: ValueType<RadiusSetting> = {
  form: "a length such as 2m, or a percentage such as 105%",
  parse(text) {
    const [, value, unit] = /^([\d.]+(?:e[-+]?\d+)?)(m|cm|mm|%)$/i.exec(text.trim()) ?? [];
    const amount = Number(value);
    if (!Number.isFinite(amount)) return undefined;
    const meters = { m: 1, cm: 0.01, mm: 0.001 }[unit?.toLowerCase() ?? ""];
    return meters === undefined ? { factor: amount / 100 } : { length: amount * meters };
  },
};

const orbit: ValueType<OrbitSetting> = {
  form: "an orbit such as 0deg 75deg 105%, each part may be auto",
  parse(text) {
    const [theta = "", phi = "", distance = "", ...more] = text.trim().split(/\s+/);
    const setting = { theta: angle.parse(theta), phi: angle.parse(phi), radius: radius.parse(distance) };
    const isMalformed = (word: string, value: unknown) => value === undefined && word.toLowerCase() !== "auto";
    if (
      more.length > 0 ||
      isMalformed(theta, setting.theta) ||
      isMalformed(phi, setting.phi) ||
      isMalformed(distance, setting.radius)
    )
      return undefined;
    return setting;
  },
};

const target: ValueType<CameraSetting["target"]> = {
  form: "a point such as 0m 1.2m 0m",
  parse(text) {
    const lengths = text
      .trim()
      .split(/\s+/)
      .map((word) => number.parse(word.replace(/m$/i, "")));
    const [x, y, z] = lengths;
    return lengths.length === 3 && x !== undefined && y !== undefined && z !== undefined ? [x, y, z] : undefined;
  },
};

function attribute<Value>(type: ValueType<Value>, defaultValue: Value): Attribute<Value> {
  return { type, defaultValue };
}

/** An attribute whose value comes from the document where it is "auto" or absent. */
function automatic<Value>(type: ValueType<Value>): Attribute<Value | undefined> {
  return { type: { ...type, form: `${type.form}, or auto` }, defaultValue: undefined };
}

/** Every attribute of a view; docs/embedding.md describes each. */
export const viewAttributes = {
  alt: attribute(anyText, ""),
  poster: attribute(anyText, ""),
  loading: attribute(oneOf("auto", "lazy", "eager"), "auto"),
  reveal: attribute(oneOf("auto", "manual"), "auto"),
  "camera-controls": attribute(flag, true),
  "camera-orbit": automatic(orbit),
  "camera-target": automatic(target),
  "field-of-view": automatic(angle),
  "min-camera-orbit": automatic(orbit),
  "max-camera-orbit": automatic(orbit),
  "auto-rotate": attribute(flag, false),
  "auto-rotate-delay": attribute(number, 3000),
  "rotation-per-second": attribute(angle, Math.PI / 6),
  "touch-action": attribute(oneOf("auto", "none", "pan-x", "pan-y"), "auto"),
  "disable-zoom": attribute(flag, false),
  "disable-pan": attribute(flag, false),
  "draw-as": attribute(oneOf("surface", "points"), "surface"),
  /** Absent: animation runs, and what starts by itself does so unless the user prefers reduced motion. */
  paused: automatic(flag),
  /** Seconds; absent: sequences follow their interpolators. */
  "sequence-time": automatic(number),
  exposure: attribute(number, 1),
  budget: attribute(megabytes, 1e9),
} as const;

export type ViewSettings = {
  readonly [Name in keyof typeof viewAttributes]: (typeof viewAttributes)[Name] extends Attribute<infer Value>
    ? Value
    : never;
};

/** The settings of an element; `onMalformed` gets a sentence for each attribute that cannot be parsed. */
export function readSettings(
  element: Pick<Element, "getAttribute">,
  onMalformed: (sentence: string) => void,
): ViewSettings {
  const settings: Record<string, unknown> = {};
  for (const [name, { type, defaultValue }] of Object.entries<Attribute<unknown>>(viewAttributes)) {
    const text = element.getAttribute(name);
    const isAutomatic = text === null || (defaultValue === undefined && text.trim().toLowerCase() === "auto");
    const value = isAutomatic ? defaultValue : type.parse(text);
    if (value === undefined && !isAutomatic) onMalformed(`${name}="${text}" is not ${type.form}`);
    settings[name] = value ?? defaultValue;
  }
  return settings as ViewSettings;
}

export function cameraSettingOf(settings: ViewSettings): CameraSetting {
  return {
    orbit: settings["camera-orbit"],
    target: settings["camera-target"],
    fieldOfView: settings["field-of-view"],
    minOrbit: settings["min-camera-orbit"],
    maxOrbit: settings["max-camera-orbit"],
  };
}
