// Tests the decoder with the files of vectors/png, which src/containers/png/png_vectors_test.cpp reads as well: both
// decoders return the same texels, and refuse the same files with the same kind of error.
// tests/generators/pngVectors.ts writes them. In verdicts.json, `crc32` is that of the texels.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { crc32 } from "node:zlib";
import { DecodeError } from "./decodeError.ts";
import { decodePixels } from "./pngPixels.ts";

interface Verdicts {
  readonly read: readonly { name: string; width: number; height: number; channels: number; crc32: string }[];
  readonly refused: readonly { name: string; kind: string }[];
}

const directory = join(import.meta.dirname, "../../../vectors/png");
const verdicts = JSON.parse(readFileSync(join(directory, "verdicts.json"), "utf8")) as Verdicts;

const pngOf = (name: string) => Uint8Array.from(readFileSync(join(directory, `${name}.png`)));

describe("the PNG vectors", () => {
  for (const { name, ...expected } of verdicts.read) {
    test(`${name} is decoded to its texels`, async () => {
      const { width, height, channels, data } = await decodePixels(pngOf(name));
      const checksum = crc32(data).toString(16).padStart(8, "0");
      assert.deepEqual({ width, height, channels, crc32: checksum }, expected);
    });
  }

  for (const { name, kind } of verdicts.refused) {
    test(`${name} is refused as ${kind}`, async () => {
      await assert.rejects(decodePixels(pngOf(name)), (error) => error instanceof DecodeError && error.kind === kind);
    });
  }

  test("every file has a verdict", () => {
    const files = readdirSync(directory).filter((name) => name.endsWith(".png"));
    const named = [...verdicts.read, ...verdicts.refused].map(({ name }) => `${name}.png`);
    assert.deepEqual(files.sort(), named.sort());
  });
});
