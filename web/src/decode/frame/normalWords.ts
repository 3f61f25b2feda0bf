// One of the two numbers of octahedral normals in a frame, spread over those of 16 bits, which shaders read.

/** `bits` of the stored numbers: 8 … 16. The largest of `bits` bits counts as the one below it. */
export function normalWords(stored: Uint32Array, bits: number): Uint16Array {
  const max = 2 ** bits - 2;
  return Uint16Array.from(stored, (value) => Math.round((Math.min(value, max) * (2 ** 16 - 2)) / max));
}
