// Values of vertex attributes, which valueColors.ts reads, a module of its own (document/parts.ts).

import { LateModule } from "../../document/lateModule.ts";
import type { GeometryDescription } from "../../document/description.ts";
import type { Stage } from "../../stage/stage.ts";
import type { addValueColors, colorMapUniformsOf, valueFrameOf, valueUniformsOf } from "./valueColors.ts";

/** What the module adds. */
export interface ValueModule {
  readonly addColors: typeof addValueColors;
  readonly colorMapUniformsOf: typeof colorMapUniformsOf;
  readonly frameOf: typeof valueFrameOf;
  readonly uniformsOf: typeof valueUniformsOf;
}

export const lateValues = new LateModule<ValueModule>("values of vertex attributes");

/** Defined in materials whose vertices have a depth in fog, which `readValue()` returns in vertex shaders. */
export const fogDepthsDefine = "FOG_DEPTHS";

/** The #defines of a material that reads the values of a stage. */
export function valueDefinesOf(
  stage: Stage,
  { value, valueUse = "color" }: Pick<GeometryDescription, "value" | "valueUse">,
): Record<string, string> {
  if (value === undefined || stage.value === undefined) return {};
  return { VALUE_COMPONENTS: `${value.components}`, [valueUse === "color" ? "VALUE_COLORS" : fogDepthsDefine]: "" };
}
