// Tests the readers with the files of vectors/sequence-1, which src/sequence/sequence_vectors_test.cpp reads as well:
// both return the same integers, and refuse the same bytes with the same kind of error.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { DecodeError } from "../decodeError.ts";
import type { Frame } from "../frame/frame.ts";
import { decodeFrameAfter } from "../frame/frame.ts";
import { framesOfFile } from "./sequenceFrames.ts";
import { fileOfFrame, readSequenceIndex } from "./sequenceIndex.ts";

const directory = join(import.meta.dirname, "../../../../vectors/sequence-1");
const names = readdirSync(directory)
  .filter((name) => name.endsWith(".igf"))
  .map((name) => name.replace(/\.igf$/, ""));
const bytesOf = (name: string) => Uint8Array.from(readFileSync(join(directory, name)));
const jsonOf = (name: string) => JSON.parse(readFileSync(join(directory, name), "utf8")) as unknown;

async function decode(index: Uint8Array<ArrayBuffer>, file: Uint8Array<ArrayBuffer>): Promise<number[][][]> {
  const description = readSequenceIndex(index);
  const [stated] = description.files;
  assert.ok(stated);
  const frames: number[][][] = [];
  let before: Frame["components"] | undefined;
  for (const { bytes } of framesOfFile(file, stated, description)) {
    before = (await decodeFrameAfter(bytes, before)).components;
    frames.push(before.map((component) => Array.from(component)));
  }
  return frames;
}

interface Verdict {
  readonly name: string;
  readonly index: string;
  /** In base 16. */
  readonly file: string;
  readonly verdict: string;
}

describe("the sequence vectors", () => {
  for (const name of names)
    test(`${name} is decoded to its integers`, async () => {
      assert.deepEqual(await decode(bytesOf(`${name}.index.json`), bytesOf(`${name}.igf`)), jsonOf(`${name}.json`));
    });

  for (const { name, index, file, verdict } of jsonOf("refused.json") as readonly Verdict[])
    test(`refuses: ${name}`, async () => {
      await assert.rejects(
        decode(new TextEncoder().encode(index), Uint8Array.from(Buffer.from(file, "hex"))),
        (thrown) => thrown instanceof DecodeError && thrown.kind === verdict,
      );
    });

  test("every cut of a file, and every changed byte that is noticed, is refused with a DecodeError", async () => {
    const [index, file] = [bytesOf("grid.index.json"), bytesOf("grid.igf")];
    const integers = jsonOf("grid.json");
    for (let length = 0; length < file.length; length += 7)
      await assert.rejects(decode(index, file.slice(0, length)), DecodeError);
    for (let at = 0; at < file.length; ++at) {
      const changed = file.slice();
      changed[at] = (changed[at] ?? 0) ^ 0x10;
      // A changed byte of deflate may still unpack to the same bytes; it never unpacks to others.
      const result = await decode(index, changed).catch((error: unknown) => error);
      if (!(result instanceof DecodeError)) assert.deepEqual(result, integers);
    }
  });

  test("an index of random changes is read or refused with a DecodeError", () => {
    const index = bytesOf("all-attributes.index.json");
    for (let at = 0; at < index.length; ++at)
      for (const byte of [0x22, 0x2d, 0x39, 0x5d, 0x00]) {
        const changed = index.slice();
        changed[at] = byte;
        try {
          readSequenceIndex(changed);
        } catch (error) {
          assert.ok(error instanceof DecodeError, String(error));
        }
      }
  });

  test("an index finds the file of a frame", () => {
    const text = new TextDecoder()
      .decode(bytesOf("grid.index.json"))
      .replace(
        /"files": \[[^\]]*\]/,
        '"files": [{"url":"a","frames":30,"bytes":1},{"url":"b","frames":30,"bytes":1},{"url":"c","frames":5,"bytes":1}]',
      );
    const index = readSequenceIndex(new TextEncoder().encode(text));
    assert.equal(index.frameCount, 65);
    assert.deepEqual(
      [0, 29, 30, 59, 60, 64].map((frame) => fileOfFrame(index, frame)),
      [0, 0, 1, 1, 2, 2],
    );
  });
});
