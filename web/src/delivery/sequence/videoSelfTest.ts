// Whether the browser decodes lossless videos to the integers that were encoded: it decodes a small one, on the way that
// all others take, and compares its first row. Colours that are converted, however little, are not exact.

import type { FrameLayout } from "../../decode/frame/frameHeader.ts";
import { imagesOfFrame } from "../../decode/frame/frameImages.ts";
import { frameOfVideo, videoSizeOf } from "../../decode/video/videoFrame.ts";
import { decoderConfigOf, VideoRuns } from "./videoRuns.ts";
import { testPackets, testRow } from "./knownVideo.ts";

/** A grid of 16 x 5 vertices; the high bytes of their coordinates in one image, the low ones below. */
export const testLayout: FrameLayout = {
  vertices: 80,
  columns: 16,
  positionBits: 16,
  normalBits: 0,
  colorComponents: 0,
  valueComponents: 0,
  valueBits: 0,
};

const maxMilliseconds = 3000;

let result: Promise<boolean> | undefined;

/** Tests once for a page. Never rejects. Where it is not so, the console has one note. */
export function decodesVideosExactly(): Promise<boolean> {
  return (result ??= test().then(
    () => true,
    (error: unknown) => {
      const reason = error instanceof Error ? error.message : String(error);
      console.info(
        `imgeo: this browser plays no lossless videos of vertices, and gets their frames instead: ${reason}`,
      );
      return false;
    },
  ));
}

async function test(): Promise<void> {
  if (!("VideoDecoder" in globalThis)) throw new Error("it has no VideoDecoder, or the page is not secure");
  const size = videoSizeOf(testLayout);
  const { supported } = await VideoDecoder.isConfigSupported(decoderConfigOf(size));
  if (supported !== true) throw new Error("it has no decoder of VP9, profile 1");
  const runs = new VideoRuns({
    size,
    packets: testPackets.map((text, number) => ({
      bytes: Uint8Array.from(atob(text), (character) => character.charCodeAt(0)),
      isKey: number === 0,
    })),
    toFrame: (pixels, number) =>
      Promise.resolve(imagesOfFrame(frameOfVideo({ pixels, layout: testLayout, rate: 1, number }))),
  });
  const timer = setTimeout(() => {
    runs.reset();
  }, maxMilliseconds);
  try {
    const frames = await runs.decode(0, new Set([0, 1]), new AbortController().signal);
    const last = frames.at(-1);
    const texels = last !== undefined && "width" in last ? last.coord[1] : undefined;
    if (!testRow.every((value, i) => texels?.[4 * Math.floor(i / 3) + (i % 3)] === value))
      throw new Error("a known row of a video has other values");
  } finally {
    clearTimeout(timer);
    runs.reset();
  }
}
