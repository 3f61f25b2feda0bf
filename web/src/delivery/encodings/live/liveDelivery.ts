// Delivery of live streams: images of SIG classic for what is static (index, texture coordinates …), and images or
// buffers that frames fill for coordinates and whatever else the stream has. `decode` of the geometry states which:
// live/streamGeometry.ts decides.

import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import type { TextureStage } from "../../../stage/stage.ts";
import { DecodeError } from "../../../decode/decodeError.ts";
import { bytesPerTexel } from "../../patchFiles.ts";
import type { PatchFile } from "../../patchFiles.ts";
import type { LiveImages } from "../../content.ts";
import type { StageBuilder } from "../../stageBuilder.ts";
import { classicDelivery } from "../classic/classicDelivery.ts";
import { bufferStageBuilder } from "../classic/classicBufferStage.ts";
import { textureStageBuilder } from "../classic/classicStage.ts";
import type { EncodingDelivery } from "../encodingDelivery.ts";

export const liveDelivery: EncodingDelivery = {
  patchFilesOf: (geometry, patch, maxTextureSize) => [
    ...streamFilesOf(patch),
    ...classicDelivery
      .patchFilesOf(geometry, patch, maxTextureSize)
      .filter(({ role }) => role !== "coord" && (role !== "value" || !hasStreamedValues(geometry))),
  ],
  stageBuilder: (geometry, patch, _, tools) =>
    geometry.decode === "gpu" ? imageStageBuilder(geometry, patch) : bufferStageBuilder(geometry, patch, tools),
  needsWorkers: () => true,
};

/** Whether frames have the values that shaders read. */
function hasStreamedValues({ value }: GeometryDescription): boolean {
  return value?.streamedRange !== undefined;
}

/** The stream, as a file of the patch. */
export function streamFilesOf({ coord: [reference], vertexCount, coord }: PatchDescription): PatchFile[] {
  if (reference === undefined) return [];
  const storedBytes = bytesPerTexel * vertexCount * coord.length;
  const chunk = { type: "coord", plane: 0 } as const;
  return [
    { role: "coord", plane: 0, reference, target: { kind: "live" }, chunk, expectedBytes: storedBytes, storedBytes },
  ];
}

function imageStageBuilder(geometry: GeometryDescription, patch: PatchDescription): StageBuilder {
  const builder = textureStageBuilder(geometry, patch);
  let live: LiveImages | undefined;
  const fileOf = (role: PatchFile["role"], plane: number): PatchFile => ({
    role,
    plane,
    reference: { url: "", firstTexel: 0 },
    target: { kind: "texture" },
    chunk: { type: "coord", plane },
    expectedBytes: 0,
    storedBytes: 0,
  });
  const drop = (): void => {
    live?.coord.forEach((_, plane) => {
      builder.drop(fileOf("coord", plane));
    });
    if (hasStreamedValues(geometry))
      live?.value.forEach((_, plane) => {
        builder.drop(fileOf("value", plane));
      });
    if (live?.color) builder.drop(fileOf("color", 0));
    live = undefined;
  };
  return {
    ...builder,
    accept(file, content, signal) {
      if (file.role !== "coord") return builder.accept(file, content, signal);
      if (content.kind !== "live" || content.vertices.kind !== "images")
        throw new DecodeError("malformed", "is no live stream in images");
      live = content.vertices;
      const accept = (role: PatchFile["role"], plane: number, image: LiveImages["coord"][number]) =>
        builder.accept(fileOf(role, plane), { kind: "image", image, channels: 4 }, signal);
      for (const [plane, image] of live.coord.entries()) void accept("coord", plane, image);
      if (hasStreamedValues(geometry))
        for (const [plane, image] of live.value.entries()) void accept("value", plane, image);
      if (live.color) void accept("color", 0, live.color);
      return undefined;
    },
    drop(file) {
      if (file.role === "coord") drop();
      else builder.drop(file);
    },
    clear() {
      live = undefined;
      builder.clear();
    },
    stage() {
      const stage = builder.stage() as TextureStage | undefined;
      if (stage === undefined) return undefined;
      const bounded = { ...stage, bounds: patch.box };
      if (live?.normal === undefined) return bounded;
      const normal = { image: live.normal, firstTexel: 0 };
      const attributes = { ...stage.attributes, normal };
      return { ...bounded, attributes, normalFormat: { kind: "octahedral", bits: 16 } as const };
    },
  };
}
