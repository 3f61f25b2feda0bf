// When to request what comes after a download: so that the next answer begins when this one ends, and neither shares
// the line nor leaves it idle.

/** Bytes that are on their way while a request travels: a round trip of 40 ms at 6 Mbit/s. */
const nearlyDoneBytes = 32 * 1024;

export class Arrival {
  /** Resolves when few bytes are still to come, or the download has ended. */
  readonly isNear: Promise<undefined>;
  readonly #resolve: () => void;

  constructor() {
    const { promise, resolve } = Promise.withResolvers<undefined>();
    this.isNear = promise;
    this.#resolve = () => {
      resolve(undefined);
    };
  }

  /** `totalBytes` is undefined while it is not known. */
  onBytes(loadedBytes: number, totalBytes: number | undefined): void {
    if (totalBytes !== undefined && totalBytes - loadedBytes <= nearlyDoneBytes) this.#resolve();
  }

  /** The download has ended, or failed. */
  end(): void {
    this.#resolve();
  }
}
