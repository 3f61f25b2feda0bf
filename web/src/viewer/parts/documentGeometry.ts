// The part "documentGeometry": geometry whose numbers are in the document, also where animation moves them, and text.

import { glyphAtlasImage } from "../../decode/glyphAtlasImage.ts";
import { addGlyphAtlases } from "../../decode/textureImage.ts";
import { addDeliveries } from "../../delivery/lateDeliveries.ts";
import { deliverMoving } from "../../delivery/movingDelivery.ts";

export { inlineGeometryReader } from "../../document/inlineGeometry.ts";
export { measureRun } from "../../text/glyphRendering.ts";
export { textReader } from "../../text/textGeometry.ts";

export function add(): void {
  addGlyphAtlases(glyphAtlasImage);
  addDeliveries({ moving: deliverMoving });
}
