// For assert.throws and assert.rejects: recognises DecodeErrors.

import { DecodeError } from "./decodeError.ts";

/** A test for DecodeErrors of a kind. */
export function refused(kind: DecodeError["kind"]): (error: unknown) => boolean {
  return (error) => error instanceof DecodeError && error.kind === kind;
}
