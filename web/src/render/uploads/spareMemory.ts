// GPU objects that are free and wait for other contents of the same size: while geometries are being replaced, the
// memory of the one before becomes that of the next, whose contents have waited for it, or of the one after next. Scripts
// may so change files many times a second without new GPU objects.

/** Contents that may wait in JavaScript for a spare object: as many as the upload pipeline uploads before a frame. */
export const maxWaitingBytes = 4 * 2 ** 20;

/** Spare objects are freed this long after the last replacement. */
const keptMs = 2000;

export class SpareMemory<GpuObject> {
  readonly #free: (object: GpuObject) => void;
  readonly #spare = new Map<string, GpuObject[]>();
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `free`: frees an object for good. */
  constructor(free: (object: GpuObject) => void) {
    this.#free = free;
  }

  /** Geometries are being replaced: objects that are freed in the next seconds are kept. */
  expectReplacements(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.clear();
    }, keptMs);
  }

  /** Keeps the object for `take` with an equal key, or frees it. */
  release(key: string, object: GpuObject): void {
    if (this.#timer === undefined) this.#free(object);
    else this.#spare.set(key, [...(this.#spare.get(key) ?? []), object]);
  }

  /** A spare object, whose contents are those of before; undefined if there is none. */
  take(key: string): GpuObject | undefined {
    return this.#spare.get(key)?.pop();
  }

  /** Frees all spare objects, and keeps no others. */
  clear(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    for (const objects of this.#spare.values()) for (const object of objects) this.#free(object);
    this.#spare.clear();
  }
}
