// Stages of SIG classic: images of index, coordinate bytes, normals and colours. Shaders read images that are on the
// GPU; workers decode images that are still files (classicBufferStage.ts).

import { DecodeError } from "../../../decode/decodeError.ts";
import type { DecodedImage } from "../../../stage/decodedImage.ts";
import type { ByVertexRole, VertexRole } from "../../../stage/attributeRows.ts";
import { attributeRows } from "../../../stage/attributeRows.ts";
import type { TexelRange, TextureStage } from "../../../stage/stage.ts";
import { isPairFormat } from "../../../stage/stage.ts";
import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import { missingBytesMidpoint } from "../../../document/dequantization.ts";
import { hasShaderPrimitive } from "../../../document/drawnFromImages.ts";
import type { PatchFile } from "../../patchFiles.ts";
import { cornerCountOf } from "../../../document/patchSizes.ts";
import { firstTexelOf, leadingPlanes, normalFormatOf } from "./classicFormat.ts";
import { bufferStageBuilder } from "./classicBufferStage.ts";
import type { BuilderTools, StageBuilder } from "../../stageBuilder.ts";
import { attainedStageName, drawRangesOf } from "../../stageBuilder.ts";

/** Chooses the builder when the first file arrives, by its kind. */
export function classicStageBuilder(
  geometry: GeometryDescription,
  patch: PatchDescription,
  tools: BuilderTools,
): StageBuilder {
  let builder: StageBuilder | undefined;
  return {
    accept(file, content, signal) {
      builder ??=
        content.kind === "image" ? textureStageBuilder(geometry, patch) : bufferStageBuilder(geometry, patch, tools);
      return builder.accept(file, content, signal);
    },
    stage: () => builder?.stage(),
    get isDivisible() {
      return builder?.isDivisible ?? true;
    },
    get storedBytes() {
      return builder?.storedBytes ?? 0;
    },
    drop(file) {
      builder?.drop(file);
    },
    clear() {
      builder?.clear();
    },
    sweep() {
      builder?.sweep();
    },
  };
}

/** Builds stages of images that are on the GPU. */
export function textureStageBuilder(geometry: GeometryDescription, patch: PatchDescription): StageBuilder {
  let coordPlanes: (TexelRange | undefined)[] = [];
  let valuePlanes: (TexelRange | undefined)[] = [];
  let index: TexelRange | undefined;
  let attributes: ByVertexRole<TexelRange> = {};
  const normalFormat = normalFormatOf(geometry);
  const cornerCount = cornerCountOf(patch);

  function channelsOf(role: PatchFile["role"]): number {
    switch (role) {
      case "coord":
        return patch.grid?.kind === "heightMap" ? 1 : 3;
      case "normal":
        if (!isPairFormat(normalFormat)) return attributeRows.normal.classic.channels;
        return normalFormat.bits === 16 ? 4 : 1;
      case "color":
        return geometry.colorComponents;
      case "value":
        return geometry.value?.components ?? 1;
      case "deformation": // is decoded in workers
        return 4;
      case "index":
      case "patch":
      case "base":
        return 3;
      default:
        return geometry.texCoordImageBits === 8 ? 3 : attributeRows[role].classic.channels;
    }
  }

  return {
    isDivisible: true,
    storedBytes: 0,
    sweep: () => undefined,

    drop({ role, plane }) {
      if (role === "coord") coordPlanes[plane] = undefined;
      else if (role === "value") valuePlanes[plane] = undefined;
      else if (role === "index") index = undefined;
      else if (isVertexRole(role)) attributes = { ...attributes, [role]: undefined };
    },

    clear() {
      coordPlanes = [];
      valuePlanes = [];
      index = undefined;
      attributes = {};
    },

    accept(file, content) {
      if (content.kind !== "image") throw new DecodeError("malformed", "is no image");
      const { image, channels } = content;
      const range = { image, firstTexel: firstTexelOf(file.reference) };
      const holdsHalves = file.role === "normal" && isPairFormat(normalFormat) && normalFormat.bits === 8;
      const needed = channelsOf(file.role);
      if (channels < needed) throw new DecodeError("malformed", `has ${channels} channels where ${needed} are needed`);
      if (file.role === "index") {
        checkHolds(range, cornerCount, patch.implicitWidth);
        index = range;
        return;
      }
      const records = patch.index === undefined && patch.grid === undefined ? cornerCount : patch.vertexCount;
      // The upper half of the image has the first number of each pair, the lower half the second.
      if (holdsHalves) checkHolds(range, texelCountOf(image) / 2 + records, image.width);
      else checkHolds(range, records, patch.index === undefined ? patch.implicitWidth : image.width);
      if (file.role === "coord") coordPlanes[file.plane] = range;
      else if (file.role === "value") valuePlanes[file.plane] = range;
      else if (isVertexRole(file.role)) attributes = { ...attributes, [file.role]: range };
    },

    stage(): TextureStage | undefined {
      const coord = leadingPlanes(coordPlanes);
      const value = leadingPlanes(valuePlanes);
      const first = coord[0];
      if (first === undefined) return undefined;
      const name = attainedStageName(patch, {
        index,
        attributes,
        coord,
        value,
      });
      const points = {
        primitive: "points",
        first: 0,
        count: patch.vertexCount || texelCountOf(first.image) - first.firstTexel,
      } as const;
      return {
        kind: "textures",
        name,
        draws: name === "points" ? [points] : drawRangesOf(patch).filter(hasShaderPrimitive),
        grid: patch.grid,
        index,
        isIndexWide: geometry.indexType === "Uint32",
        implicitWidth: name === "points" ? first.image.width : patch.implicitWidth,
        coord,
        coordPlaneCount: patch.coord.length,
        missingBytesMidpoint: missingBytesMidpoint(geometry, patch.coord.length, coord.length),
        attributes,
        normalFormat,
        texCoordBits: geometry.texCoordImageBits,
        colorComponents: geometry.colorComponents,
        value:
          value.length === 0
            ? undefined
            : {
                planes: value,
                planeCount: patch.value.length,
                missingBytesMidpoint: (256 ** (patch.value.length - value.length) - 1) / 2,
              },
      };
    },
  };
}

function isVertexRole(role: PatchFile["role"]): role is VertexRole {
  return role in attributeRows;
}

function texelCountOf(image: DecodedImage): number {
  return image.width * image.height;
}

/** Throws unless elements 0 .. count - 1, in rows of `implicitWidth`, are texels of the image. */
function checkHolds({ image, firstTexel: first }: TexelRange, count: number, implicitWidth: number): void {
  if (count === 0) return;
  const last = count - 1;
  const lastTexel = first + Math.floor(last / implicitWidth) * image.width + Math.min(last, implicitWidth - 1);
  if (implicitWidth > image.width || lastTexel >= texelCountOf(image)) {
    throw new DecodeError(
      "malformed",
      `has ${image.width} x ${image.height} texels; ${count} in rows of ${implicitWidth} from texel ${first} on do not fit`,
    );
  }
}
