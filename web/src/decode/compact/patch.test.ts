// Tests the decoder with vectors/compact-1 and compact-2, which the tests of the encoder write and the C++ decoder reads as well, and
// with damaged files of every kind.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { DecodeError } from "../decodeError.ts";
import { decodePatches } from "./patch.ts";
import { TestRandom } from "./rangeEncoder.testing.ts";
import { stated, verdictOn } from "./verdict.testing.ts";
import type { Edit, Refused } from "./vectors.testing.ts";
import { editedPayload, payloadOfRefused, readPayload, readVector, vectorNames } from "./vectors.testing.ts";

const versions = [1, 2] as const;

const decode = (payload: Uint8Array) => decodePatches(payload, stated);
const headersOf = (payload: Uint8Array) => decodePatches(payload, ({ header }) => header);

/** Everything that a reader must refuse in a payload (docs/formats/compact.md), by the messages of this reader. */
const refusals = [
  /is no image of compact/,
  /of version \d+ of compact/,
  /features of compact/,
  /number that is too long/,
  /ends before its streams do/,
  /bases beside patches/,
  /segments of points/,
  /segments of lines/,
  /attribute of a patch twice/,
  /stream that nothing reads/,
  ...["attributes", "types of patches", "patches", "vertices", "wedges", "elements"].map(
    (what) => new RegExp(`holds \\d+ ${what}; \\d+ are allowed`),
  ),
  ...[
    "kind of an attribute",
    "number of components",
    "bits of an attribute",
    "mode of an attribute",
    "topology",
    "bits of a position",
    "flags",
    "number of attributes",
    "attribute",
    "number of patches",
    "type of a patch",
    "number of wedges",
    "shift of normals",
    "step of the grid",
    "origin of the grid",
    "number of segments",
    "shift of residuals",
  ].map((what) => new RegExp(`as ${what}; `)),
  /stream that is longer/,
  /stream that is shorter/,
  /more vertices than/,
  /fewer vertices than/,
  /vertex that is not decoded yet/,
  /node of the boundary that is not decoded yet/,
  /segment that does not exist/,
  /vertex outside of its lattice/,
  /more wedges than/,
  /fewer wedges than/,
  /another wedge of a vertex that has one/,
  /wedge that its vertex does not have/,
  /normal outside of its octahedron/,
  /texture coordinate that its bits cannot hold/,
  /value that its bits cannot hold/,
];

/** The message with which a payload is refused; empty if it is not. */
function refusalOf(payload: Uint8Array): string {
  try {
    decodePatches(payload, () => undefined);
    return "";
  } catch (error) {
    return error instanceof DecodeError ? error.message : assert.fail(String(error));
  }
}

for (const version of versions) {
  const names = vectorNames(version);
  const payloads = new Map(names.map((name) => [name, readPayload(name, version)]));
  describe(`a file of version ${version} of compact`, () => {
    for (const name of names) {
      test(`"${name}" decodes to what its vector states`, () => {
        assert.deepEqual(decode(payloads.get(name)!), readVector(name, version));
      });
    }

    test("has vectors of every topology, of several patches, with a grid, with seams and every attribute", () => {
      assert.ok(names.length > 15);
      const files = names.map((name) => headersOf(payloads.get(name)!));
      assert.ok(files.some((headers) => headers.length > 1));
      const headers = files.flat();
      for (const topology of ["points", "lines", "triangles"])
        assert.ok(
          headers.some((header) => header.topology === topology),
          topology,
        );
      assert.ok(headers.some(({ grid }) => grid));
      assert.equal(
        headers.some(({ grid, positionBits }) => grid && positionBits > 16),
        version > 1,
      );
      assert.ok(headers.some(({ vertexCount, wedgeCount }) => wedgeCount > vertexCount));
      const attributes = headers.flatMap((header) => header.attributes);
      for (const kind of ["normal", "texCoord", "color", "other"])
        assert.ok(
          attributes.some((type) => type.kind === kind),
          kind,
        );
      assert.ok(attributes.some(({ isUniform }) => isUniform) && attributes.some(({ isDerived }) => isDerived));
    });

    test("is refused or decoded as the vectors state, after every edit that they state", () => {
      for (const edit of readVector("edits", version) as Edit[])
        assert.equal(verdictOn(editedPayload(edit, version)), edit.verdict, JSON.stringify(edit));
    });

    test("is refused as the vectors state, which cover every reason to refuse it", () => {
      const refused = (readVector("refused", version) as Refused[]).map((each) => ({
        ...each,
        payload: payloadOfRefused(each),
      }));
      for (const { name, payload, verdict } of refused) assert.equal(verdictOn(payload), verdict, name);
      const messages = new Set(
        [
          ...refused.map(({ payload }) => payload),
          ...(readVector("edits", version) as Edit[]).map((edit) => editedPayload(edit, version)),
        ].map(refusalOf),
      );
      for (const refusal of version === 1 ? refusals.filter(({ source }) => !source.includes("features")) : refusals)
        assert.ok(
          [...messages].some((message) => refusal.test(message)),
          `no vector is refused with ${String(refusal)}`,
        );
      for (const message of messages)
        assert.ok(
          message === "" || refusals.some((refusal) => refusal.test(message)),
          `the list of refusals lacks "${message}"`,
        );
    });

    test("is decoded or refused in a short time, whatever its bytes", () => {
      const random = new TestRandom(1);
      // Processor time, since other processes delay the wall clock.
      const milliseconds = () => process.cpuUsage().user / 1000;
      const started = milliseconds();
      let refusals = 0;
      for (let round = 0; round < 4000; ++round) {
        const payload = payloads.get(names[random.below(names.length)]!)!.slice();
        for (let edit = random.below(4); edit >= 0; --edit) {
          // Half of the edits change the header, which holds the counts.
          payload[random.below(random.below(2) === 0 ? Math.min(64, payload.length) : payload.length)] =
            random.below(256);
        }
        const before = milliseconds();
        if (typeof verdictOn(payload) === "string") refusals += 1;
        assert.ok(milliseconds() - before < 5000, `round ${round} took ${milliseconds() - before} ms`);
      }
      assert.ok(refusals > 1000 && refusals < 3999, `${refusals} refusals`);
      assert.ok(milliseconds() - started < 60_000);
    });
  });
}

describe("a damaged header of compact", () => {
  test("is refused with a message that names the problem", () => {
    const payload = readPayload("sphere", 1);
    const withByte = (byteOffset: number, value: number) => {
      const changed = payload.slice();
      changed[byteOffset] = value;
      return changed;
    };
    for (const [changed, kind, message] of [
      [withByte(0, 0), "malformed", /no image of compact/],
      [withByte(3, 3), "unsupported", /version 3 of compact, which is not known/],
      [withByte(5, 4), "malformed", /4 as kind of an attribute; 0 to 3/],
      [withByte(10, 4), "malformed", /4 as topology; 1 to 3/],
      [withByte(11, 31), "malformed", /31 as bits of a position/],
      [withByte(13, 17), "malformed", /17 as number of attributes/],
      [withByte(14, 1), "malformed", /1 as attribute/],
      [withByte(15, 0), "malformed", /0 as number of patches/],
      [payload.slice(0, 20), "truncated", /ends before its streams do/],
    ] as const) {
      assert.throws(
        () => decode(changed),
        (error) => error instanceof DecodeError && error.kind === kind && message.test(error.message),
      );
    }
  });
});
