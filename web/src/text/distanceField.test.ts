import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { distanceField } from "./distanceField.ts";

/** How much of each texel a disk covers, by 16 x 16 samples. */
function disk(size: number, center: number, radius: number): Uint8Array {
  return Uint8Array.from({ length: size * size }, (_, texel) => {
    const [x, y] = [texel % size, Math.floor(texel / size)];
    let inside = 0;
    for (let sample = 0; sample < 256; ++sample) {
      const [dx, dy] = [x + ((sample % 16) + 0.5) / 16 - center, y + (Math.floor(sample / 16) + 0.5) / 16 - center];
      if (dx * dx + dy * dy < radius * radius) ++inside;
    }
    return Math.round((255 * inside) / 256);
  });
}

describe("a distance field", () => {
  test("locates a curved edge within a tenth of a texel, and distances within a fifth", () => {
    const [size, center, radius, spread] = [48, 23.3, 14.6, 8];
    const field = distanceField(disk(size, center, radius), size, size, spread);
    let [worst, worstOnEdge] = [0, 0];
    field.forEach((value, texel) => {
      const distance = radius - Math.hypot((texel % size) + 0.5 - center, Math.floor(texel / size) + 0.5 - center);
      const expected = Math.min(Math.max(distance, -spread), spread);
      const error = Math.abs((value / 255 - 0.5) * 2 * spread - expected);
      worst = Math.max(worst, error);
      if (Math.abs(distance) < 0.5) worstOnEdge = Math.max(worstOnEdge, error);
    });
    assert.ok(worst < 0.2 && worstOnEdge < 0.1, `${worst} ${worstOnEdge}`);
  });

  test("is linear for horizontal and vertical edges, and 128 in half-covered texels", () => {
    const [width, height] = [12, 5];
    for (const isHorizontal of [true, false]) {
      const size = isHorizontal ? { width, height } : { width: height, height: width };
      const positionOf = (texel: number) => (isHorizontal ? texel % width : Math.floor(texel / height));
      const coverage = Uint8Array.from({ length: width * height }, (_, texel) =>
        positionOf(texel) < 6 ? 255 : positionOf(texel) === 6 ? 128 : 0,
      );
      const field = distanceField(coverage, size.width, size.height, 4);
      field.forEach((value, texel) => {
        const expected = 0.5 + Math.min(Math.max(6 - positionOf(texel), -4), 4) / 8;
        assert.ok(Math.abs(value / 255 - expected) < 0.01, `${positionOf(texel)}: ${value}`);
      });
    }
  });

  test("is 0 for an empty image and 255 for a full one", () => {
    assert.ok(distanceField(new Uint8Array(20), 5, 4, 8).every((value) => value === 0));
    assert.ok(distanceField(new Uint8Array(20).fill(255), 5, 4, 8).every((value) => value === 255));
  });
});
