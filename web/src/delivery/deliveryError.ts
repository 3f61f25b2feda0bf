import { DecodeError } from "../decode/decodeError.ts";
import { RequestError } from "../scheduler/download.ts";

/** A file that could not be loaded or decoded, or a node (without a URL) that is not read. Users see the message. */
export class DeliveryError extends Error {
  override readonly name = "DeliveryError";
  readonly kind: RequestError["kind"] | DecodeError["kind"];
  readonly url: string;
  /** The message without the URL. */
  readonly reason: string;

  constructor(kind: DeliveryError["kind"], url: string, reason: string) {
    super(url === "" ? reason : `${url}: ${reason}`);
    this.kind = kind;
    this.url = url;
    this.reason = reason;
  }
}

/** The error of a file none of whose URLs can be loaded; each of `errors`, at least one, names one. */
export function joinedError(errors: readonly [DeliveryError, ...DeliveryError[]]): DeliveryError {
  const [first, ...others] = errors;
  const reason = [first.reason, ...others.map(({ message }) => message)].join("; ");
  return new DeliveryError(first.kind, first.url, reason);
}

export function asDeliveryError(error: unknown, url: string): DeliveryError {
  if (error instanceof DeliveryError) return error;
  if (error instanceof RequestError || error instanceof DecodeError)
    return new DeliveryError(error.kind, url, error.message);
  return new DeliveryError("malformed", url, error instanceof Error ? error.message : String(error));
}
