// The part "files": geometry in images of classic and in arrays of BG.

import { bgDelivery } from "../../delivery/encodings/bg/bgDelivery.ts";
import { classicDelivery } from "../../delivery/encodings/classic/classicDelivery.ts";
import { addEncodings } from "../../delivery/encodings/encodings.ts";

export function add(): void {
  addEncodings({ bg: bgDelivery, classic: classicDelivery });
}
