// The element types of typed arrays, by the names that documents give them.

import type { ElementArray } from "./vertexArray.ts";

export const elementTypes = ["Int8", "Uint8", "Int16", "Uint16", "Int32", "Uint32", "Float32"] as const;
export type ElementType = (typeof elementTypes)[number];

const arrayTypes = {
  Int8: Int8Array,
  Uint8: Uint8Array,
  Int16: Int16Array,
  Uint16: Uint16Array,
  Int32: Int32Array,
  Uint32: Uint32Array,
  Float32: Float32Array,
} as const satisfies Record<ElementType, unknown>;

const glTypes: Readonly<Record<ElementType, number>> = {
  Int8: 0x1400,
  Uint8: 0x1401,
  Int16: 0x1402,
  Uint16: 0x1403,
  Int32: 0x1404,
  Uint32: 0x1405,
  Float32: 0x1406,
};

export function byteSizeOf(type: ElementType): number {
  return arrayTypes[type].BYTES_PER_ELEMENT;
}

export function elementTypeOf(array: ElementArray): ElementType {
  return elementTypes.find((type) => array instanceof arrayTypes[type]) ?? "Uint8";
}

export function isUnsigned(type: ElementType): boolean {
  return type.startsWith("Uint");
}

/** WebGL's constant for the type, such as gl.BYTE. */
export function glTypeOf(type: ElementType): number {
  return glTypes[type];
}

export function arrayTypeOf(type: ElementType): (typeof arrayTypes)[ElementType] {
  return arrayTypes[type];
}
