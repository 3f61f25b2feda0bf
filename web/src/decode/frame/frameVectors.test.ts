// Tests the decoder with the files of vectors/frame-1, which src/live/frame_vectors_test.cpp reads as well: both
// decoders return the same integers, and refuse the same bytes with the same kind of error.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { DecodeError } from "../decodeError.ts";
import { decodeFrame } from "./frame.ts";
import { encodeFrame } from "./encodeFrame.testing.ts";
import type { FrameHeader } from "./frameHeader.ts";

const directory = join(import.meta.dirname, "../../../../vectors/frame-1");
const names = readdirSync(directory)
  .filter((name) => name.endsWith(".igf"))
  .map((name) => name.replace(/\.igf$/, ""));
const bytesOf = (name: string) => Uint8Array.from(readFileSync(join(directory, `${name}.igf`)));
const jsonOf = (name: string) => JSON.parse(readFileSync(join(directory, `${name}.json`), "utf8")) as unknown;

interface Verdict {
  readonly name: string;
  /** In base 16. */
  readonly frame: string;
  readonly verdict: string;
}

describe("the frame vectors", () => {
  for (const name of names) {
    test(`${name} is decoded to its integers`, async () => {
      const { header, components } = await decodeFrame(bytesOf(name));
      const { packedBytes, isDifference, ...fields } = header;
      assert.ok(packedBytes > 0 && !isDifference);
      assert.deepEqual({ ...fields, components: components.map((values) => Array.from(values)) }, jsonOf(name));
    });

    test(`${name} is encoded by the tests' encoder to a frame of the same integers`, async () => {
      const frame = await decodeFrame(bytesOf(name));
      const again = await decodeFrame(encodeFrame(frame.header, frame.components));
      const withoutLength = (header: FrameHeader) => ({ ...header, packedBytes: 0 });
      assert.deepEqual(withoutLength(again.header), withoutLength(frame.header));
      assert.deepEqual(again.components, frame.components);
    });
  }

  for (const { name, frame, verdict } of jsonOf("refused") as readonly Verdict[]) {
    test(`refuses: ${name}`, async () => {
      await assert.rejects(
        decodeFrame(Uint8Array.from(Buffer.from(frame, "hex"))),
        (thrown) => thrown instanceof DecodeError && thrown.kind === verdict,
      );
    });
  }

  test("every cut and every changed byte of a frame is refused", async () => {
    const bytes = bytesOf("grid");
    for (let length = 0; length < bytes.length; ++length) await assert.rejects(decodeFrame(bytes.slice(0, length)));
    for (let at = 0; at < bytes.length; ++at) {
      const changed = bytes.slice();
      changed[at] = (changed[at] ?? 0) ^ 0x10;
      // A changed byte of deflate may still unpack to the same bytes; it never unpacks to others.
      const result = await decodeFrame(changed).catch((error: unknown) => error);
      if (!(result instanceof DecodeError))
        assert.deepEqual((result as { components: unknown }).components, (await decodeFrame(bytes)).components);
    }
  });
});
