/**
 * An error in bytes that are decoded. The message is a predicate, such as "is interlaced", that follows the name of the
 * file.
 */
export class DecodeError extends Error {
  override readonly name = "DecodeError";
  readonly kind: "truncated" | "malformed" | "unsupported" | "limit";

  constructor(kind: DecodeError["kind"], message: string, options?: ErrorOptions) {
    super(message, options);
    this.kind = kind;
  }
}
