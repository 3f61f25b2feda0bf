import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { DecodeError } from "./decodeError.ts";
import { checkImage, mediaTypeOf } from "./imageFile.ts";
import { checkWebp } from "./webp.ts";

const folder = join(import.meta.dirname, "../../../vectors/webp");

type Verdict = { readonly width: number; readonly height: number } | { readonly error: string };

const verdicts = JSON.parse(readFileSync(join(folder, "verdicts.json"), "utf8")) as Record<string, Verdict>;

describe("WebP images of vertex data", () => {
  test("have the verdicts of the converter's reader", () => {
    const names = readdirSync(folder).filter((name) => name.endsWith(".webp"));
    assert.deepEqual(names.toSorted(), Object.keys(verdicts).toSorted());
    for (const [name, verdict] of Object.entries(verdicts)) {
      const bytes = new Uint8Array(readFileSync(join(folder, name)));
      if ("error" in verdict) {
        assert.throws(() => checkImage(bytes), { name: "DecodeError", kind: verdict.error }, name);
        continue;
      }
      assert.deepEqual(checkImage(bytes), { width: verdict.width, height: verdict.height, channels: 4 }, name);
      assert.equal(mediaTypeOf(bytes), "image/webp");
    }
  });

  test("are refused wherever they end, and where a byte follows", () => {
    const bytes = new Uint8Array(readFileSync(join(folder, "rgba.webp")));
    for (let length = 0; length < bytes.length; ++length) {
      assert.throws(() => checkWebp(bytes.subarray(0, length)), DecodeError, `prefix of ${length} bytes`);
    }
    assert.throws(() => checkWebp(Uint8Array.from([...bytes, 0])), { kind: "malformed" });
  });

  test("are refused beyond the largest edge", () => {
    const bytes = new Uint8Array(readFileSync(join(folder, "rgba.webp")));
    assert.throws(() => checkImage(bytes, 8), { kind: "limit" });
  });
});
