// The part "files": geometry in images of classic and in arrays of BG, and wide lines, which are in no other files.

import { decodeDataImage } from "../../decode/image.ts";
import { checkImage } from "../../decode/imageFile.ts";
import { bgDelivery } from "../../delivery/encodings/bg/bgDelivery.ts";
import { classicDelivery } from "../../delivery/encodings/classic/classicDelivery.ts";
import { addEncodings } from "../../delivery/encodings/encodings.ts";
import { lateDataImages } from "../../delivery/lateDataImages.ts";
import { lateWideLines } from "../../render/lines/lateWideLines.ts";
import { wideLines } from "../../render/lines/wideLineParts.ts";
import { testVertexTextures } from "../../render/picking/vertexTextureTest.ts";
import { blurredBufferChunk, imageVertexChunk } from "../../render/shaders/imageVertexChunk.ts";
import { lateImageVertices } from "../../render/shaders/lateImageVertices.ts";
import { BlurredVertices } from "../../render/stages/blurredVertices.ts";
import { imageUniformsOf } from "../../render/stages/imageUniforms.ts";

export function add(): void {
  addEncodings({ bg: bgDelivery, classic: classicDelivery });
  lateDataImages.add({ check: checkImage, decode: decodeDataImage });
  lateImageVertices.add({
    vertexChunk: imageVertexChunk,
    blurredBufferChunk,
    uniformsOf: imageUniformsOf,
    blurredVertices: (...needed) => new BlurredVertices(...needed),
    testTextures: testVertexTextures,
  });
  lateWideLines.add(wideLines);
}
