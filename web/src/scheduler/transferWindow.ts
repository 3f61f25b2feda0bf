// How many bytes may be on their way. Downloads share the line: several at a time arrive together, late, so that decoding
// begins when the last byte is here. One after the other, each is decoded while the next arrives. The line is busy as
// long as the requested bytes cover a round trip at the line's rate (its bandwidth-delay product).

/** Enough for 20 Mbit/s and 40 ms, and less than two patches of usual size. */
const minWindowBytes = 96 * 1024;

/** Covers rounds that take longer than the shortest. */
const latencyMargin = 1.5;

/** Covers tasks of the main thread, which has to send the next request: starting the runtime takes longer on few cores. */
const minWindowMs = 100;

/** Bytes and times that are this old count half. */
const halfLifeMs = 500;

/** A gap between chunks that is longer than this is a pause of the server or of the page, not the line's rate. */
const maxGapMs = 250;

export class TransferWindow {
  #assumedBytes = 0;
  #latencyMs = Infinity;
  #receivedBytes = 0;
  #receivedMs = 0;
  #lastChunkAt = -Infinity;

  /** A download may start while those that run have to receive at most this. */
  get byteLength(): number {
    if (this.#receivedMs === 0 || this.#latencyMs === Infinity) return Math.max(minWindowBytes, this.#assumedBytes);
    const bytesPerMs = this.#receivedBytes / this.#receivedMs;
    return Math.max(minWindowBytes, bytesPerMs * Math.max(minWindowMs, latencyMargin * this.#latencyMs));
  }

  /** What the line carries while the page is busy: so much may be on its way until files have been received. */
  assume(byteLength: number): void {
    this.#assumedBytes = byteLength;
  }

  /** A server's answer has begun `latencyMs` after its request. */
  onHeaders(latencyMs: number): void {
    this.#latencyMs = Math.min(this.#latencyMs, latencyMs);
  }

  /** Bytes of any download have arrived at this time, in milliseconds of a clock that never goes back. */
  onBytes(byteLength: number, now: number): void {
    const gapMs = now - this.#lastChunkAt;
    this.#lastChunkAt = now;
    if (gapMs > maxGapMs) return;
    const kept = 2 ** (-gapMs / halfLifeMs);
    this.#receivedBytes = this.#receivedBytes * kept + byteLength;
    this.#receivedMs = this.#receivedMs * kept + gapMs;
  }
}
