// Compares the decoder in WebAssembly with the one in TypeScript, which patch.test.ts compares with the vectors, as
// src/containers/compact/vectors_test.cpp does with the C++ decoder compiled for the processor.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { Edit, Refused } from "./vectors.testing.ts";
import { editedPayload, payloadOfRefused, readPayload, readVector, vectorNames } from "./vectors.testing.ts";
import { DecodeError } from "../decodeError.ts";
import type { DecodedPatch, DecodeFile } from "./decodedFile.ts";
import { decodeFile, useWasm } from "./decodeFile.ts";
import { TestRandom } from "./rangeEncoder.testing.ts";
import { decodeWithTypeScript } from "./typescriptDecoder.ts";
import { maxKeptBytes, WasmDecoder, WasmRefusal } from "./wasmDecoder.ts";
import { readModule, wasmModule } from "./wasmDecoder.testing.ts";

const module = wasmModule();
const wasm = new WasmDecoder(module);
const decodeWithWasm: DecodeFile = (payload) => wasm.decode(payload);

const isSoak = process.env.IMGEO_SOAK !== undefined;
/** Number of damaged payloads and seed of their damage; `make soak` sets more, and another one each time. */
const mutantCount = Number(process.env.IMGEO_MUTANTS ?? 1500);
const seed = Number(process.env.IMGEO_RANDOM_SEED ?? 7);

/** What a decoder returns, or the kind of its refusal. Rethrows other errors. */
function outcomeOf(decode: DecodeFile, payload: Uint8Array): DecodedPatch[] | DecodeError["kind"] {
  try {
    return decode(payload);
  } catch (error) {
    if (error instanceof DecodeError || error instanceof WasmRefusal) return error.kind;
    throw error;
  }
}

/** Whether both decoders accept a payload; they return the same arrays or refuse with the same kind. */
function isAcceptedByBoth(payload: Uint8Array, name: string): boolean {
  const expected = outcomeOf(decodeWithTypeScript, payload);
  assert.deepEqual(outcomeOf(decodeWithWasm, payload), expected, name);
  return typeof expected !== "string";
}

describe("the decoder in WebAssembly", () => {
  for (const version of [1, 2] as const) {
    const names = vectorNames(version);
    for (const name of names)
      test(`returns the arrays of "${name}" of version ${version} that TypeScript returns`, () => {
        assert.ok(isAcceptedByBoth(readPayload(name, version), name));
      });

    test(`has the verdict of the vectors of version ${version} on every edit and on everything to be refused`, () => {
      const edits = readVector("edits", version) as Edit[];
      // `make soak` takes all of them.
      for (const edit of edits.filter((_, n) => isSoak || n % 4 === 0)) {
        const payload = editedPayload(edit, version);
        const isAccepted = isAcceptedByBoth(payload, JSON.stringify(edit));
        assert.equal(isAccepted, typeof edit.verdict === "number");
        if (!isAccepted) assert.equal(outcomeOf(decodeWithWasm, payload), edit.verdict);
      }
      const refused = readVector("refused", version) as Refused[];
      for (const each of refused)
        assert.equal(outcomeOf(decodeWithWasm, payloadOfRefused(each)), each.verdict, each.name);
      assert.ok(edits.length > 1000 && refused.length > 10);
    });

    test(`accepts and refuses what TypeScript does, whatever the bytes of version ${version}`, () => {
      const random = new TestRandom(seed);
      const payloads = names.map((name) => readPayload(name, version));
      let accepted = 0;
      for (let round = 0; round < mutantCount; ++round) {
        const payload = payloads[random.below(payloads.length)]!.slice();
        for (let edit = random.below(3); edit >= 0; --edit)
          payload[random.below(random.below(2) === 0 ? Math.min(64, payload.length) : payload.length)] =
            random.below(256);
        if (isAcceptedByBoth(payload, `seed ${seed}, round ${round}`)) ++accepted;
      }
      assert.ok(accepted > mutantCount / 30 && accepted < mutantCount * (29 / 30), `${accepted} accepted`);
    });
  }

  test("decodes after a refusal what it decoded before it, with a new instance", () => {
    const decoder = new WasmDecoder(module);
    const payload = readPayload("sphere");
    const before = decoder.decode(payload);
    const kept = decoder.memoryBytes;
    assert.ok(kept > 0);
    assert.deepEqual(decoder.decode(payload), before);
    assert.equal(decoder.memoryBytes, kept, "a file of the same size needs no more memory");
    assert.throws(() => decoder.decode(payload.subarray(0, 20)), WasmRefusal);
    assert.equal(decoder.memoryBytes, 0);
    assert.deepEqual(decoder.decode(payload), before);
  });

  test("drops an instance whose memory has grown above the bound", () => {
    const decoder = new WasmDecoder(module);
    decoder.decode(readPayload("sphere"));
    assert.ok(decoder.memoryBytes > 0 && decoder.memoryBytes < maxKeptBytes);
    // The payload lies in the memory of the module. Bytes behind the streams are those of an image's last row.
    const large = new Uint8Array(maxKeptBytes);
    large.set(readPayload("sphere"));
    assert.deepEqual(decoder.decode(large), decodeWithTypeScript(readPayload("sphere")));
    assert.equal(decoder.memoryBytes, 0);
  });
});

describe("a file of compact, in a worker that has the module", () => {
  test("is refused with the sentence of TypeScript", () => {
    const sentenceOn = (decode: DecodeFile, payload: Uint8Array): string => {
      try {
        decode(payload);
        return "";
      } catch (error) {
        return error instanceof DecodeError ? `${error.kind}: ${error.message}` : assert.fail(String(error));
      }
    };
    useWasm(module);
    const payloads = (readVector("refused") as Refused[]).map(payloadOfRefused);
    const sentences = payloads.map((payload) => sentenceOn(decodeWithTypeScript, payload));
    assert.deepEqual(
      payloads.map((payload) => sentenceOn(decodeFile, payload)),
      sentences,
    );
    assert.ok(new Set(sentences).size > 10 && !sentences.includes(""));
    assert.deepEqual(decodeFile(readPayload("sphere")), decodeWithTypeScript(readPayload("sphere")));
  });

  test("is decoded by TypeScript where the module returns tables of another layout", () => {
    const bytes = Buffer.from(readModule());
    const nameAt = bytes.indexOf("decodeToTable");
    assert.ok(nameAt > 0);
    bytes.write("decodeToTable0", nameAt);
    const other = new WebAssembly.Module(bytes);
    assert.throws(() => new WasmDecoder(other).decode(readPayload("sphere")), TypeError);
    useWasm(other);
    assert.deepEqual(decodeFile(readPayload("sphere")), decodeWithTypeScript(readPayload("sphere")));
  });
});
