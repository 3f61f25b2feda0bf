// Tests the readers with the files of vectors/video-1, which src/video/video_vectors_test.cpp reads as well.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { crc32 } from "../crc32.ts";
import { DecodeError } from "../decodeError.ts";
import { readSequenceIndex } from "../sequence/sequenceIndex.ts";
import type { VideoPixels, VideoSize } from "./videoFrame.ts";
import { frameOfVideo, videoFrame, videoSizeOf } from "./videoFrame.ts";
import { readWebm } from "./webm.ts";

const vectors = join(import.meta.dirname, "../../../../vectors");
const bytesOf = (name: string) => Uint8Array.from(readFileSync(join(vectors, name)));
const jsonOf = (name: string) => JSON.parse(readFileSync(join(vectors, name), "utf8")) as unknown;

interface Video extends VideoSize {
  readonly packets: readonly { readonly bytes: number; readonly crc32: number; readonly isKey: boolean }[];
}

/** Colours side by side, as a decoder has them that gives RGBA. */
function interleaved(rgb: Uint8Array, { width, height }: VideoSize): VideoPixels {
  const bytes = new Uint8Array(4 * width * height).fill(255);
  for (let i = 0; i < rgb.length; ++i) bytes[4 * Math.floor(i / 3) + (i % 3)] = rgb[i] ?? 0;
  return { bytes, offsets: [0, 1, 2], strides: [4 * width, 4 * width, 4 * width], step: 4 };
}

/** Planes of green, blue and red, with rows that are longer than the image. */
function planar(rgb: Uint8Array, { width, height }: VideoSize): VideoPixels {
  const stride = width + 5;
  const bytes = new Uint8Array(3 * stride * height).fill(255);
  const planeOfChannel = [2, 0, 1] as const;
  for (let i = 0; i < rgb.length; ++i) {
    const pixel = Math.floor(i / 3);
    const plane = planeOfChannel[(i % 3) as 0 | 1 | 2];
    bytes[stride * (height * plane + Math.floor(pixel / width)) + (pixel % width)] = rgb[i] ?? 0;
  }
  const [red, green, blue] = planeOfChannel.map((plane) => stride * height * plane);
  return { bytes, offsets: [red ?? 0, green ?? 0, blue ?? 0], strides: [stride, stride, stride], step: 1 };
}

describe("the video vectors", () => {
  for (const [name, expected] of Object.entries(jsonOf("video-1/videos.json") as Record<string, Video>)) {
    const index = readSequenceIndex(bytesOf(`sequence-1/${name}.index.json`));
    const rgb = bytesOf(`video-1/${name}.rgb`);
    const size = videoSizeOf(index);
    const imageBytes = 3 * size.width * size.height;

    test(`${name}: the file has the packets that it states`, () => {
      const { width, height, packets } = readWebm(bytesOf(`video-1/${name}.webm`));
      assert.deepEqual({ width, height }, size);
      assert.deepEqual(
        packets.map(({ bytes, isKey }) => ({ bytes: bytes.length, crc32: crc32(bytes), isKey })),
        expected.packets,
      );
    });

    test(`${name}: pixels of any order are the integers of the sequence`, () => {
      const frames = jsonOf(`sequence-1/${name}.json`) as number[][][];
      for (const [number, integers] of frames.entries())
        for (const pixelsOf of [interleaved, planar]) {
          const image = rgb.subarray(number * imageBytes, (number + 1) * imageBytes);
          const { header, components } = frameOfVideo({
            pixels: pixelsOf(image, size),
            layout: index,
            rate: 25,
            number,
          });
          assert.deepEqual(
            components.map((component) => Array.from(component)),
            integers,
          );
          assert.equal(header.time, number / 25);
        }
    });
  }

  test("pixels that differ in the last bit, or are of another frame, are refused", () => {
    const index = readSequenceIndex(bytesOf("sequence-1/grid.index.json"));
    const size = videoSizeOf(index);
    const image = bytesOf("video-1/grid.rgb").subarray(0, 3 * size.width * size.height);
    const read = (number: number) =>
      videoFrame({ pixels: interleaved(image, size), layout: index, rate: 25, number, form: { kind: "images" } });
    assert.equal(read(0).header.number, 0);
    assert.throws(() => read(1), /has frame 0 instead of frame 1/);
    for (const at of [0, 17, 3 * size.width * (size.height - 1) + 5]) {
      image[at] = (image[at] ?? 0) ^ 1;
      assert.throws(() => read(0), /it is not lossless/);
      image[at] = (image[at] ?? 0) ^ 1;
    }
  });

  for (const { name, file, verdict } of jsonOf("video-1/files.json") as Record<"name" | "file" | "verdict", string>[])
    test(`${name}: ${verdict}`, () => {
      const read = () => readWebm(Uint8Array.from(Buffer.from(file, "hex")));
      if (verdict === "read") assert.ok(read().packets.length > 0);
      else assert.throws(read, (thrown) => thrown instanceof DecodeError && thrown.kind === verdict);
    });

  test("every cut of a file is refused, and no changed byte does anything else", () => {
    const video = bytesOf("video-1/one-frame.webm");
    for (let length = 0; length < video.length; ++length)
      assert.throws(() => readWebm(video.slice(0, length)), DecodeError);
    for (let at = 0; at < video.length; ++at)
      for (const change of [1, 0x80, 0xff]) {
        const changed = video.slice();
        changed[at] = (changed[at] ?? 0) ^ change;
        try {
          readWebm(changed);
        } catch (error) {
          assert.ok(error instanceof DecodeError, String(error));
        }
      }
  });
});
