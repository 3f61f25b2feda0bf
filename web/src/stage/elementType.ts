// The element types of typed arrays, by the names that documents give them.

import type { ElementArray } from "./vertexArray.ts";

const arrayTypes = {
  Int8: Int8Array,
  Uint8: Uint8Array,
  Int16: Int16Array,
  Uint16: Uint16Array,
  Int32: Int32Array,
  Uint32: Uint32Array,
  Float32: Float32Array,
} as const;

export type ElementType = keyof typeof arrayTypes;

export function byteSizeOf(type: ElementType): number {
  return arrayTypes[type].BYTES_PER_ELEMENT;
}

export function elementTypeOf(array: ElementArray): ElementType {
  const types = Object.keys(arrayTypes) as ElementType[];
  return types.find((type) => array instanceof arrayTypes[type]) ?? "Uint8";
}

export function arrayTypeOf(type: ElementType): (typeof arrayTypes)[ElementType] {
  return arrayTypes[type];
}
