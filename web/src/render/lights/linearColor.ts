// Colours of X3D, whose components three.js keeps as they are.

import type { Color } from "three";
import { LinearSRGBColorSpace } from "three";
import type { Vec3 } from "../../document/description.ts";

/** Sets the components without a conversion: three.js' working space is linear too. */
export function setColor(color: Color, [red, green, blue]: Vec3): void {
  color.setRGB(red, green, blue, LinearSRGBColorSpace);
}
