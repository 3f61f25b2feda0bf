// Classic SIG: images of index, coordinate bytes, normals and colours. As textures
// they are handed on as they are, and the shader fetches vertices from them; what
// comes as files is decoded on the CPU.

import { DecodeError } from "../../../decode/decodeError.ts";
import type { DecodedImage } from "../../../stage/decodedImage.ts";
import type { TexelRange, TextureStage } from "../../../stage/stage.ts";
import { isPairCode } from "../../../stage/stage.ts";
import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import { missingBytesMidpoint } from "../../../document/dequantization.ts";
import type { PatchFile } from "../../patchFiles.ts";
import { cornerCountOf } from "../../patchFiles.ts";
import { firstTexelOf, normalCodeOf } from "./classicFormat.ts";
import { bufferStageBuilder } from "./classicBufferStage.ts";
import type { BuilderTools, StageBuilder } from "../../stageBuilder.ts";
import { attainedStageName, drawRangesOf } from "../../stageBuilder.ts";

/** Which of the two is known when the first file is here. */
export function classicStageBuilder(
  geometry: GeometryDescription,
  patch: PatchDescription,
  tools: BuilderTools,
): StageBuilder {
  let builder: StageBuilder | undefined;
  return {
    accept(part, content, signal) {
      builder ??=
        content.kind === "image" ? textureStageBuilder(geometry, patch) : bufferStageBuilder(geometry, patch, tools);
      return builder.accept(part, content, signal);
    },
    stage: () => builder?.stage(),
    get isDivisible() {
      return builder?.isDivisible ?? true;
    },
    get storedBytes() {
      return builder?.storedBytes ?? 0;
    },
    drop(part) {
      builder?.drop(part);
    },
    clear() {
      builder?.clear();
    },
    sweep() {
      builder?.sweep();
    },
  };
}

function textureStageBuilder(geometry: GeometryDescription, patch: PatchDescription): StageBuilder {
  let planes: (TexelRange | undefined)[] = [];
  let values: (TexelRange | undefined)[] = [];
  let here: Partial<Record<"index" | "normal" | "texCoord" | "color", TexelRange | undefined>> = {};
  const normalCode = normalCodeOf(geometry);
  const corners = cornerCountOf(patch);

  function channelsOf(role: PatchFile["role"]): number {
    switch (role) {
      case "coord":
        return patch.grid?.kind === "heightMap" ? 1 : 3;
      case "normal":
        return isPairCode(normalCode) ? 1 : 3;
      case "texCoord":
        return 4;
      case "color":
        return geometry.colorComponents;
      case "value":
        return geometry.value?.components ?? 1;
      default:
        return 3;
    }
  }

  return {
    isDivisible: true,
    storedBytes: 0,
    sweep: () => undefined,

    drop({ role, plane }) {
      if (role === "coord") planes[plane] = undefined;
      else if (role === "value") values[plane] = undefined;
      else if (role !== "patch" && role !== "base") here[role] = undefined;
    },

    clear() {
      planes = [];
      values = [];
      here = {};
    },

    accept(part, content) {
      if (content.kind !== "image") throw new DecodeError("malformed", "is no image");
      const { image, channels } = content;
      const range = { image, firstTexel: firstTexelOf(part.reference) };
      const isPairs = part.role === "normal" && isPairCode(normalCode);
      const needed = channelsOf(part.role);
      if (channels < needed) throw new DecodeError("malformed", `has ${channels} channels where ${needed} are needed`);
      if (part.role === "index") {
        checkHolds(range, corners, patch.implicitWidth);
        here.index = range;
        return;
      }
      const records = patch.index === undefined && patch.grid === undefined ? corners : patch.vertexCount;
      if (isPairs) checkHolds(range, texelsOf(image) / 2 + records, image.width);
      else checkHolds(range, records, patch.index === undefined ? patch.implicitWidth : image.width);
      if (part.role === "coord") planes[part.plane] = range;
      else if (part.role === "value") values[part.plane] = range;
      else if (part.role !== "patch" && part.role !== "base") here[part.role] = range;
    },

    stage(): TextureStage | undefined {
      const coord = firstOf(planes);
      const value = firstOf(values);
      const first = coord[0];
      if (first === undefined) return undefined;
      const name = attainedStageName(patch, {
        index: here.index,
        normal: here.normal,
        color: here.color,
        coord,
        value,
      });
      const points = {
        primitive: "points",
        first: 0,
        count: patch.vertexCount || texelsOf(first.image) - first.firstTexel,
      } as const;
      return {
        kind: "textures",
        name,
        draws: name === "points" ? [points] : drawRangesOf(patch),
        grid: patch.grid,
        index: here.index,
        isIndexWide: geometry.indexType === "Uint32",
        implicitWidth: name === "points" ? first.image.width : patch.implicitWidth,
        coord,
        coordPlaneCount: patch.coord.length,
        missingBytesMidpoint: missingBytesMidpoint(geometry, patch.coord.length, coord.length),
        normal: here.normal,
        normalCode,
        color: here.color,
        colorComponents: geometry.colorComponents,
        texCoord: here.texCoord,
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

/** A plane is of use only when all above it are here. */
function firstOf(planes: readonly (TexelRange | undefined)[]): TexelRange[] {
  const whole = Array.from(planes); // without holes
  const missing = whole.indexOf(undefined);
  return whole.slice(0, missing < 0 ? undefined : missing).filter((plane) => plane !== undefined);
}

function texelsOf(image: DecodedImage): number {
  return image.width * image.height;
}

/** Running numbers 0 .. count - 1, in rows of `implicitWidth`, must be texels of the image. */
function checkHolds({ image, firstTexel: first }: TexelRange, count: number, implicitWidth: number): void {
  if (count === 0) return;
  const last = count - 1;
  const lastTexel = first + Math.floor(last / implicitWidth) * image.width + Math.min(last, implicitWidth - 1);
  if (implicitWidth > image.width || lastTexel >= texelsOf(image)) {
    throw new DecodeError(
      "malformed",
      `has ${image.width} x ${image.height} texels; ${count} in rows of ${implicitWidth} from texel ${first} on do not fit`,
    );
  }
}
