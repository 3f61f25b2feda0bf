// What the bytes of a file become, and what decides that.

import type { BaseBuffers } from "../decode/compact/baseBuffers.ts";
import type { LevelGroup } from "../decode/compact/levelGroup.ts";
import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import type { DataImage } from "../decode/image.ts";
import type { TextureFile } from "../decode/textureImage.ts";
import type { InputOf, JobName, OutputOf } from "../decode/jobs.ts";
import type { SamplingDescription } from "../document/description.ts";
import type { DecodedImage } from "../stage/decodedImage.ts";
import type { GpuValues, GpuVertices, NormalFormat } from "../stage/stage.ts";
import type { IndexArray } from "../stage/vertexArray.ts";

export type Content =
  | ({ readonly kind: "image" } & DataImage)
  | ({ readonly kind: "textureImage" } & TextureImage)
  | { readonly kind: "bytes"; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly kind: "live"; readonly vertices: LiveVertices }
  | { readonly kind: "patches"; readonly patches: readonly PatchBuffers[] }
  | { readonly kind: "bases"; readonly bases: readonly BaseBuffers[] }
  | { readonly kind: "group"; readonly group: LevelGroup };

/**
 * The form that a file is decoded to: a texture, its own bytes (of any file, or of an image), or either, as the GPU
 * allows; a texture image; all patches or base meshes that it holds, or the group of triangles of a level of detail,
 * which a job decodes; or what frames of a live stream fill (live/).
 */
export type ContentTarget =
  | { readonly kind: "live" }
  | { readonly kind: "texture" | "bytes" | "imageBytes" | "either" }
  | { readonly kind: "textureImage"; readonly sampling: SamplingDescription }
  | { readonly kind: "patches"; readonly job: FileJob<PatchBuffers[]> }
  | { readonly kind: "bases"; readonly job: FileJob<BaseBuffers[]> }
  | { readonly kind: "group"; readonly job: FileJob<LevelGroup> };

/** The images or arrays that frames of a live stream fill. */
export type LiveVertices = LiveImages | LiveArrays;

export interface LiveImages {
  readonly kind: "images";
  readonly coord: readonly DecodedImage[];
  readonly normal: DecodedImage | undefined;
  readonly color: DecodedImage | undefined;
  readonly value: readonly DecodedImage[];
  /** On the GPU. */
  readonly byteLength: number;
}

export interface LiveArrays {
  readonly kind: "arrays";
  readonly vertexCount: number;
  /** Size of the image that the coordinates would have, whose columns and rows an index may name. */
  readonly width: number;
  readonly height: number;
  readonly coord: GpuVertices;
  readonly normal: GpuVertices | undefined;
  readonly normalFormat: NormalFormat;
  readonly color: GpuVertices | undefined;
  readonly value: GpuValues | undefined;
  readonly byteLength: number;
  /**
   * Makes `normal` follow from these triangles, in the displayed frame and all later ones. Rejects when the stream
   * ends.
   */
  deriveNormals(index: IndexArray): Promise<void>;
}

/** The jobs that turn the bytes of a file into an Output. */
type FileJob<Output> = {
  [Name in JobName]: OutputOf<Name> extends Output
    ? Uint8Array<ArrayBuffer> extends InputOf<Name>
      ? Name
      : never
    : never;
}[JobName];

/** A texture image, of any format that the browser decodes. */
export interface TextureImage {
  readonly image: DecodedImage;
  readonly hasAlpha: boolean;
}

/** Decodes a texture image and uploads it. Rejects with DecodeError, or with the signal's reason. */
export type MakeTextureImage = (
  file: TextureFile,
  sampling: SamplingDescription,
  signal: AbortSignal,
) => Promise<TextureImage>;

/** The content of a file whose download began before the runtime. */
export type PrefetchedContent = { readonly byteLength: number } & (
  | { readonly bases: readonly BaseBuffers[] }
  | { readonly patches: readonly PatchBuffers[] }
  | { readonly group: LevelGroup }
  | { readonly bytes: Uint8Array<ArrayBuffer> }
);

/** What a file whose download began before the runtime may be requested as. */
export type PrefetchedKind = "bases" | "patches" | "group" | "bytes";
