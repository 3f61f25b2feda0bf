/** Bytes that are not what they claim to be. */
export class DecodeError extends Error {
  override readonly name = "DecodeError";
  readonly kind: "truncated" | "malformed" | "unsupported" | "limit";

  constructor(kind: DecodeError["kind"], message: string, options?: ErrorOptions) {
    super(message, options);
    this.kind = kind;
  }
}
