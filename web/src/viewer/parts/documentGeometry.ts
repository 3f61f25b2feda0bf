// The part "documentGeometry": geometry whose numbers are in the document, also where animation moves them, and text.

import { addDeliveries } from "../../delivery/lateDeliveries.ts";
import { deliverMoving } from "../../delivery/movingDelivery.ts";

export { inlineGeometryReader } from "../../document/inlineGeometry.ts";
export { measureRun } from "../../text/glyphRendering.ts";
export { textReader } from "../../text/textGeometry.ts";

export function add(): void {
  addDeliveries({ moving: deliverMoving });
}
