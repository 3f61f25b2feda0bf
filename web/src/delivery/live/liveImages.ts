// The images on the GPU that frames of one epoch fill, each frame in place of the one before.

import type { FrameImages, Texels } from "../../decode/frame/frameImages.ts";
import type { WritableImage } from "../../stage/decodedImage.ts";
import type { LiveImages } from "../resourcePool.ts";
import { bytesPerTexel } from "../patchFiles.ts";

export class FrameTarget implements LiveImages {
  readonly #all: readonly WritableImage[];
  readonly coord: LiveImages["coord"];
  readonly normal: LiveImages["normal"];
  readonly color: LiveImages["color"];
  readonly value: LiveImages["value"];
  readonly byteLength: number;

  /** Allocates images for frames like this one, with its vertices. */
  constructor(frame: FrameImages, makeImage: (width: number, height: number) => WritableImage) {
    const { width, height } = frame;
    this.#all = texelsOf(frame).map(() => makeImage(width, height));
    const images = this.#all.map(({ image }) => image);
    this.byteLength = images.length * width * height * bytesPerTexel;
    this.coord = images.splice(0, frame.coord.length);
    this.normal = frame.normal && images.shift();
    this.color = frame.color && images.shift();
    this.value = images;
    this.write(frame);
  }

  /** Replaces all vertices before the next frame of the page. */
  write(frame: FrameImages): void {
    texelsOf(frame).forEach((texels, index) => this.#all[index]?.write(texels));
  }

  close(): void {
    for (const { image } of this.#all) image.close();
  }
}

function texelsOf({ coord, normal, color, value }: FrameImages): readonly Texels[] {
  return [...coord, normal, color, ...value].filter((texels) => texels !== undefined);
}
