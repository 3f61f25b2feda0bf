// Images on the GPU that frames of one epoch fill, for shaders that read vertices from images.

import type { FrameImages, Texels } from "../../decode/frame/frameImages.ts";
import type { WritableImage } from "../../stage/decodedImage.ts";
import type { LiveImages } from "../content.ts";
import { bytesPerTexel } from "../patchFiles.ts";
import type { DecodedFrame, FrameTarget, TargetTools } from "./frameTarget.ts";

export class ImageTarget implements FrameTarget {
  readonly #tools: TargetTools;
  #all: readonly WritableImage[] = [];
  readonly form = { kind: "images" } as const;
  vertices: LiveImages | undefined;

  constructor(tools: TargetTools) {
    this.#tools = tools;
  }

  async decode(bytes: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<DecodedFrame> {
    const frame = await this.#tools.runJob("frameImages", bytes, signal);
    return {
      header: frame.header,
      display: () => {
        this.write(frame);
      },
    };
  }

  /** Replaces all vertices. */
  write(frame: FrameImages): void {
    if (this.vertices === undefined) this.#allocate(frame);
    texelsOf(frame).forEach((texels, index) => this.#all[index]?.write(texels));
  }

  close(): void {
    for (const { image } of this.#all) image.close();
  }

  #allocate(frame: FrameImages): void {
    const { width, height } = frame;
    this.#all = texelsOf(frame).map(() => this.#tools.makeWritableImage(width, height));
    const images = this.#all.map(({ image }) => image);
    this.vertices = {
      kind: "images",
      byteLength: images.length * width * height * bytesPerTexel,
      coord: images.splice(0, frame.coord.length),
      normal: frame.normal && images.shift(),
      color: frame.color && images.shift(),
      value: images,
    };
  }
}

function texelsOf({ coord, normal, color, value }: FrameImages): readonly Texels[] {
  return [...coord, normal, color, ...value].filter((texels) => texels !== undefined);
}
