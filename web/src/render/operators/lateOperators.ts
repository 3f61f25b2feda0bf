// What maps vertices by operators, in a module of its own (document/parts.ts).

import type { AppearanceDescription, GeometryDescription } from "../../document/description.ts";
import { LateModule } from "../../document/lateModule.ts";
import type { Operator } from "../../document/operators.ts";
import type { operatedBounds } from "../../scene/operatorFrame.ts";
import type { Stage } from "../../stage/stage.ts";
import { operatorsDefine } from "../shaders/vertexFormat.ts";
import type { formatOf, OperatedFormat, StageOperation } from "./stageOperation.ts";

/** What the module adds. */
export interface OperatorModule {
  /** GLSL that defines `operate` for materials with OPERATORS. */
  readonly vertexChunk: string;
  readonly formatOf: typeof formatOf;
  readonly StageOperation: typeof StageOperation;
  /** A box around the mapped vertices of a patch, for which the document states none. */
  readonly boundsOf: typeof operatedBounds;
}

export const lateOperators = new LateModule<OperatorModule>("operators");

/** What maps the vertices of a shape; undefined where nothing does. */
export function operatorsOf({ operators = [] }: AppearanceDescription): readonly Operator[] | undefined {
  return operators.length > 0 ? operators : undefined;
}

/** Undefined for a shape without operators. */
export function operatedFormatOf(
  stage: Stage,
  geometry: GeometryDescription,
  appearance: AppearanceDescription,
): OperatedFormat | undefined {
  const operators = operatorsOf(appearance);
  return operators && lateOperators.required.formatOf(stage, geometry, operators);
}

/** GLSL that defines `operate`, which vertex shaders call. */
export const operateVertexChunk = (): string => /* glsl */ `
#ifdef ${operatorsDefine}
${lateOperators.added?.vertexChunk ?? ""}
#else
void operate(inout vec3 position, inout vec3 normal) {}
#endif
`;
