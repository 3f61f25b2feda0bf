import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { refused } from "./decodeError.testing.ts";
import { decodeImage } from "./image.ts";
import { pngOf } from "./png.testing.ts";

describe("an image", () => {
  const png = pngOf({ width: 4, height: 2 });

  test("that decodes to another size than its header states is refused and closed", async () => {
    let closed = 0;
    const wrongImage = {
      width: 2,
      height: 4,
      close: () => {
        closed += 1;
      },
    };
    await assert.rejects(
      decodeImage(png, () => Promise.resolve(wrongImage)),
      refused("malformed"),
    );
    assert.equal(closed, 1);
  });

  test("that the browser cannot decode is malformed", async () => {
    await assert.rejects(
      decodeImage(png, () => Promise.reject(new DOMException("no", "InvalidStateError"))),
      refused("malformed"),
    );
  });

  test("is not passed to the browser if its header is refused", async () => {
    let calls = 0;
    await assert.rejects(
      decodeImage(pngOf({ width: 4, height: 2, colorType: 4 }), () => {
        calls += 1;
        return Promise.reject(new Error("called"));
      }),
      refused("unsupported"),
    );
    assert.equal(calls, 0);
  });
});
