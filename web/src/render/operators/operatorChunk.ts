// GLSL of operators on geometry, and their uniforms: the functions of document/operators.ts, with normals.

import type { IUniform } from "three";
import type { Vec3 } from "../../document/description.ts";
import type { Operator } from "../../document/operators.ts";
import { blurRadiusOf, isOdd, maxOperators } from "../../document/operators.ts";
import type { OperatorFrame } from "../../document/operatorFrame.ts";

export interface OperatorUniforms extends Record<string, IUniform> {
  operatorCount: IUniform<number>;
  /** For each operator a and its kind, b and the sign of the permutation. */
  operators: IUniform<readonly number[]>;
  operatorMin: IUniform<Vec3>;
  operatorSize: IUniform<Vec3>;
  /** In texels; 0: images are not filtered. */
  blurRadius: IUniform<number>;
}

const kinds = ["affine", "power", "fold", "clamp", "steps", "permute"] as const satisfies Operator["kind"][];

export function operatorUniformsOf(list: readonly Operator[], { min, size }: OperatorFrame): OperatorUniforms {
  const operators = list.flatMap(({ kind, ...vectors }) => (kind === "blur" ? [] : [{ kind, ...vectors }]));
  const numbers = operators.flatMap(({ kind, a, b }) => [...a, kinds.indexOf(kind), ...b, isOdd(a) ? -1 : 1]);
  return {
    operatorCount: { value: operators.length },
    blurRadius: { value: blurRadiusOf(list) },
    operators: { value: Array.from({ length: 8 * maxOperators }, (_, n) => numbers[n] ?? 0) },
    operatorMin: { value: min },
    operatorSize: { value: size },
  };
}

/** Included after `latticeStep`. Normals get the side that the winding of the mapped triangles has. */
export const operatorChunk = /* glsl */ `
uniform int operatorCount;
uniform vec4 operators[${2 * maxOperators}];
uniform vec3 operatorMin, operatorSize;

float largestOf(vec3 v) {
  v = abs(v);
  return max(v.x, max(v.y, v.z));
}

void operate(inout vec3 position, inout vec3 normal) {
  vec3 extent = operatorSize * latticeStep;
  vec3 c = (position - operatorMin) / operatorSize;
  vec3 n = normal * extent;
  for (int i = 0; i < operatorCount; ++i) {
    vec4 head = operators[2 * i], tail = operators[2 * i + 1];
    vec3 a = head.xyz, b = tail.xyz, slope = vec3(1.0);
    int kind = int(head.w);
    if (kind == ${kinds.indexOf("affine")}) {
      c = a * c + b;
      slope = a;
    } else if (kind == ${kinds.indexOf("power")}) {
      slope = a * pow(max(c, 1e-4), a - 1.0);
      c = pow(max(c, 0.0), a);
    } else if (kind == ${kinds.indexOf("fold")}) {
      bvec3 isBeyond = greaterThan(c, a);
      slope = mix(vec3(1.0), vec3(-1.0), isBeyond);
      c = mix(c, 2.0 * a - c, isBeyond);
    } else if (kind == ${kinds.indexOf("clamp")}) {
      vec3 clamped = clamp(c, a, b);
      slope = vec3(equal(c, clamped));
      c = clamped;
    } else if (kind == ${kinds.indexOf("steps")}) {
      c = floor(c * a + 0.5) / a;
    } else {
      ivec3 from = ivec3(a);
      c = vec3(c[from.x], c[from.y], c[from.z]);
      n = vec3(n[from.x], n[from.y], n[from.z]) * tail.w;
    }
    // The cofactors of the slopes; where they flatten the surface to a line, the normal stays.
    slope /= max(largestOf(slope), 1e-30);
    vec3 turned = n * slope.yzx * slope.zxy;
    if (turned != vec3(0.0)) n = turned / largestOf(turned);
  }
  position = operatorMin + c * operatorSize;
  normal = n / extent;
}
`;
