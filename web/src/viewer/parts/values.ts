// The part "values": values of vertex attributes, which colour shapes or are depths in fog.

import { lateValues } from "../../render/materials/lateValues.ts";
import {
  addValueColors,
  colorMapUniformsOf,
  valueFrameOf,
  valueUniformsOf,
} from "../../render/materials/valueColors.ts";

export function add(): void {
  lateValues.add({
    addColors: addValueColors,
    colorMapUniformsOf,
    frameOf: valueFrameOf,
    uniformsOf: valueUniformsOf,
  });
}
