// The decoder against vectors/, which the encoder's tests wrote and the C++
// decoder reads as well, and against damage of every kind.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { DecodeError } from "../decodeError.ts";
import { decodePatches } from "./patch.ts";
import { TestRandom } from "./rangeEncoder.testing.ts";
import { stated, verdictOn } from "./verdict.testing.ts";
import { readPayload, readVector, vectorNames } from "./vectors.testing.ts";

const names = vectorNames();

const decode = (payload: Uint8Array) => decodePatches(payload, stated);
const headersOf = (payload: Uint8Array) => decodePatches(payload, ({ header }) => header);

interface Edit {
  readonly file: string;
  /** Bytes and what to put there. */
  readonly edits: [number, number][];
  /** Where to cut, after that. */
  readonly length?: number;
  readonly verdict: number | DecodeError["kind"];
}

describe("a file of compact", () => {
  for (const name of names) {
    test(`"${name}" decodes to what its vector states`, () => {
      assert.deepEqual(decode(readPayload(name)), readVector(name));
    });
  }

  test("there are vectors of every topology, of several patches, with and without a grid, seams and every attribute", () => {
    assert.ok(names.length > 15);
    const files = names.map((name) => headersOf(readPayload(name)));
    assert.ok(files.some((headers) => headers.length > 1));
    const headers = files.flat();
    for (const topology of ["points", "lines", "triangles"]) assert.ok(headers.some((header) => header.topology === topology), topology);
    assert.ok(headers.some(({ grid }) => grid));
    assert.ok(headers.some(({ vertexCount, wedgeCount }) => wedgeCount > vertexCount));
    const attributes = headers.flatMap((header) => header.attributes);
    for (const kind of ["normal", "texCoord", "color", "other"]) assert.ok(attributes.some((type) => type.kind === kind), kind);
    assert.ok(attributes.some(({ isUniform }) => isUniform) && attributes.some(({ isDerived }) => isDerived));
  });

  test("is refused as it should be, or decodes as it should, after every edit that the vectors state", () => {
    const payloads = new Map(names.map((name) => [name, readPayload(name)]));
    for (const edit of readVector("edits") as Edit[]) {
      const payload = payloads.get(edit.file)!.slice();
      for (const [place, value] of edit.edits) payload[place] = value;
      assert.equal(verdictOn(payload.subarray(0, edit.length)), edit.verdict, JSON.stringify(edit));
    }
  });

  test("is decoded or refused, quickly, whatever its bytes", () => {
    const random = new TestRandom(1);
    const payloads = names.map(readPayload);
    // Processor time, since a busy machine may take any.
    const milliseconds = () => process.cpuUsage().user / 1000;
    const started = milliseconds();
    let refusals = 0;
    for (let round = 0; round < 4000; ++round) {
      const payload = payloads[random.below(payloads.length)]!.slice();
      for (let edit = random.below(4); edit >= 0; --edit) {
        // Headers are what hostile counts come from.
        payload[random.below(random.below(2) === 0 ? Math.min(64, payload.length) : payload.length)] = random.below(256);
      }
      const before = milliseconds();
      if (typeof verdictOn(payload) === "string") refusals += 1;
      assert.ok(milliseconds() - before < 5000, `round ${round} took ${milliseconds() - before} ms`);
    }
    assert.ok(refusals > 1000 && refusals < 3999, `${refusals} refusals`);
    assert.ok(milliseconds() - started < 60_000);
  });

  test("is refused with a sentence that names what is wrong", () => {
    const payload = readPayload("sphere");
    const at = (place: number, value: number) => { const changed = payload.slice(); changed[place] = value; return changed; };
    for (const [changed, kind, message] of [
      [at(0, 0), "malformed", /no image of compact/], [at(3, 2), "unsupported", /version 2 of compact, not 1/],
      [at(5, 4), "malformed", /4 as kind of an attribute; 0 to 3/], [at(10, 4), "malformed", /4 as topology; 1 to 3/],
      [at(11, 31), "malformed", /31 as bits of a position/], [at(13, 17), "malformed", /17 as number of attributes/],
      [at(14, 1), "malformed", /1 as attribute/], [at(15, 0), "malformed", /0 as number of patches/],
      [payload.slice(0, 20), "truncated", /ends before its streams do/],
    ] as const) {
      assert.throws(() => decode(changed), (error) => error instanceof DecodeError && error.kind === kind && message.test(error.message));
    }
  });
});
