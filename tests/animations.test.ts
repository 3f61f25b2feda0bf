// Compares animations of glTF files as pages play them, after `imgeo convert`, with three's GLTFLoader and
// AnimationMixer: the transforms of all moved nodes at fixed times.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { AnimationMixer, Quaternion, Vector3, type AnimationClip, type Object3D } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { play } from "../web/src/animation/animation.testing.ts";
import type { Value } from "../web/src/animation/fieldTypes.ts";
import { converter } from "./browser/paths.ts";

type Interpolation = "LINEAR" | "STEP" | "CUBICSPLINE";
type Path = "translation" | "rotation" | "scale";

/** A GLB of a triangle for each channel, whose node the channel moves. */
function glbOf(channels: readonly { path: Path; interpolation: Interpolation; seconds: number[] }[]): Buffer {
  const chunks: Buffer[] = [];
  const bufferViews: object[] = [];
  const accessors: object[] = [];
  const accessor = (numbers: readonly number[], type: "SCALAR" | "VEC3" | "VEC4", extremes = false): number => {
    const bytes = Buffer.from(Float32Array.from(numbers).buffer);
    const size = { SCALAR: 1, VEC3: 3, VEC4: 4 }[type];
    bufferViews.push({ buffer: 0, byteOffset: Buffer.concat(chunks).length, byteLength: bytes.length });
    chunks.push(bytes);
    const axis = (of: (...values: number[]) => number) =>
      Array.from({ length: size }, (_, i) => of(...numbers.filter((_, n) => n % size === i)));
    accessors.push({
      bufferView: bufferViews.length - 1,
      componentType: 5126,
      count: numbers.length / size,
      type,
      ...(extremes && { min: axis(Math.min), max: axis(Math.max) }),
    });
    return accessors.length - 1;
  };
  const position = accessor([0, 0, 0, 1, 0, 0, 0, 1, 0], "VEC3", true);
  let seed = 1;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5;
  const samplers = channels.map(({ path, interpolation, seconds }) => {
    const size = path === "rotation" ? 4 : 3;
    const values = seconds.flatMap(() => {
      const value = Array.from({ length: size }, () => 4 * random());
      const unit = path === "rotation" ? value.map((number) => number / Math.hypot(...value)) : value;
      const tangent = () => Array.from({ length: size }, random);
      return interpolation === "CUBICSPLINE" ? [...tangent(), ...unit, ...tangent()] : unit;
    });
    const type = path === "rotation" ? "VEC4" : "VEC3";
    return { input: accessor(seconds, "SCALAR", true), output: accessor(values, type), interpolation };
  });
  const document = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: channels.map((_, i) => i) }],
    nodes: channels.map((_, i) => ({ name: `node${i}`, mesh: 0 })),
    meshes: [{ primitives: [{ attributes: { POSITION: position } }] }],
    animations: [
      {
        name: "move",
        samplers,
        channels: channels.map(({ path }, i) => ({ sampler: i, target: { node: i, path } })),
      },
    ],
    accessors,
    bufferViews,
    buffers: [{ byteLength: Buffer.concat(chunks).length }],
  };
  const json = Buffer.from(JSON.stringify(document));
  const text = Buffer.concat([json, Buffer.alloc(-json.length & 3, " ")]);
  const binary = Buffer.concat(chunks);
  const words = (...numbers: number[]) => Buffer.from(Uint32Array.from(numbers).buffer);
  return Buffer.concat([
    words(0x46546c67, 2, 28 + text.length + binary.length, text.length, 0x4e4f534a),
    text,
    words(binary.length, 0x004e4942),
    binary,
  ]);
}

function withSite(glb: Buffer, use: (scene: string, directory: string) => void): void {
  const directory = mkdtempSync(join(tmpdir(), "imgeo-animations-"));
  try {
    writeFileSync(join(directory, "in.glb"), glb);
    const site = join(directory, "site");
    execFileSync(converter, ["convert", join(directory, "in.glb"), "-o", site, "--no-pictures"], { stdio: "pipe" });
    use(readFileSync(join(site, "scene.x3d"), "utf8"), directory);
  } finally {
    rmSync(directory, { recursive: true });
  }
}

async function gltfOf(glb: Buffer): Promise<{ scene: Object3D; clip: AnimationClip }> {
  const bytes = Uint8Array.from(glb).buffer;
  const { scene, animations } = await new GLTFLoader().parseAsync(bytes, "");
  const [clip] = animations;
  assert.ok(clip);
  return { scene, clip };
}

function numbersOf(value: Value | undefined): number[] {
  assert.ok(Array.isArray(value) && value.every((number) => typeof number === "number"), String(value));
  return value;
}

/** Radians, exact for small angles; Quaternion.angleTo() is not. */
function angleBetween(a: Quaternion, b: Quaternion): number {
  const distance = (sign: number) => Math.hypot(a.x - sign * b.x, a.y - sign * b.y, a.z - sign * b.z, a.w - sign * b.w);
  return 4 * Math.asin(Math.min(distance(1), distance(-1)) / 2);
}

const channels = (["translation", "rotation", "scale"] as const).flatMap((path) =>
  (["LINEAR", "STEP", "CUBICSPLINE"] as const).flatMap((interpolation) => [
    { path, interpolation, seconds: [0, 0.4, 1.1, 1.3, 4] },
    { path, interpolation, seconds: [0.5, 3] },
  ]),
);

test("every kind of glTF channel moves its node as in three.js, at fixed times", async () => {
  const glb = glbOf(channels);
  const { scene, clip } = await gltfOf(glb);
  const mixer = new AnimationMixer(scene);
  mixer.clipAction(clip).play();
  withSite(glb, (markup) => {
    const page = play(markup);
    assert.deepEqual(page.warnings, []);
    page.frameAt(0); // the clock begins with the first frame
    let sum = 0;
    let count = 0;
    for (let step = 0; step < 100; ++step) {
      const time = 0.0171 + 0.0395 * step; // not at a key, where steps differ by a rounding
      mixer.setTime(time);
      page.frameAt(time);
      for (const [i, { path, interpolation }] of channels.entries()) {
        const object = scene.getObjectByName(`node${i}`);
        assert.ok(object);
        const numbers = numbersOf(page.drawn(`node${i}`, path));
        const [x = 0, y = 0, z = 0, angle = 0] = numbers;
        const difference =
          path === "rotation"
            ? angleBetween(
                object.quaternion,
                new Quaternion().setFromAxisAngle(new Vector3(x, y, z).normalize(), angle),
              )
            : new Vector3(x, y, z).distanceTo(path === "scale" ? object.scale : object.position);
        const bound = interpolation === "CUBICSPLINE" ? 4e-3 : 2e-5;
        assert.ok(difference <= bound, `node${i}.${path}, ${interpolation}, ${time} s: off by ${difference}`);
        sum += difference;
        count += 1;
      }
    }
    assert.ok(sum / count < 5e-4, `mean difference ${sum / count}`);
  });
});

test("an animated site equals its input, and its export moves in the same way", async () => {
  const linear = channels.filter(({ interpolation }) => interpolation === "LINEAR");
  const glb = glbOf(linear);
  const files: Buffer[] = [];
  withSite(glb, (_, directory) => {
    const [input, site, back] = ["in.glb", "site", "back.glb"].map((name) => join(directory, name));
    const run = (...words: string[]) => execFileSync(converter, words, { encoding: "utf8" });
    assert.match(run("verify", site ?? "", input ?? ""), /The site equals its input/);
    assert.match(run("info", site ?? ""), /animation: 1 TimeSensor, 6 interpolators, 12 routes/);
    run("export", site ?? "", "-o", back ?? "");
    files.push(readFileSync(back ?? ""));
  });
  const [first, second] = [await gltfOf(glb), await gltfOf(files[0] ?? Buffer.of())];
  for (const { scene, clip } of [first, second]) {
    const mixer = new AnimationMixer(scene);
    mixer.clipAction(clip).play();
    mixer.setTime(1.7);
  }
  for (const i of linear.keys()) {
    const [a, b] = [first, second].map(({ scene }) => scene.getObjectByName(`node${i}`));
    assert.ok(a && b);
    assert.ok(a.position.distanceTo(b.position) < 1e-5 && a.scale.distanceTo(b.scale) < 1e-5);
    assert.ok(a.quaternion.angleTo(b.quaternion) < 1e-3);
  }
});
