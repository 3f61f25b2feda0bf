// Triangles in an order in which the GPU finds most of their vertices transformed
// already: Sander, Nehab and Barczak, "Fast triangle reordering for vertex locality
// and reduced overdraw", 2007. Fans around one vertex after the other, the next
// among those that are still in the cache. Linear time.

/** Vertices that a GPU remembers, at least. Larger caches lose little by it. */
const cacheSize = 16;

/** Corners of triangles over vertices 0 … vertexCount - 1, in their new order; each triangle keeps its turn. */
export function orderForVertexCache(corners: Int32Array, vertexCount: number): Int32Array {
  return new CacheOrder(corners, vertexCount).run();
}

class CacheOrder {
  readonly #corners: Int32Array;
  readonly #vertexCount: number;
  readonly #ordered: Int32Array;
  /** The triangles around vertex v are `around` from `firsts[v]` on. */
  readonly #firsts: Int32Array;
  readonly #around: Int32Array;
  /** Per vertex: triangles that are still to come, and when it entered the cache. */
  readonly #live: Int32Array;
  readonly #entered: Int32Array;
  /** Per triangle. */
  readonly #isDone: Uint8Array;
  /** Vertices that have been met, the latest last: where to go on when the cache has nothing to offer. */
  readonly #met: Int32Array;
  #metCount = 0;
  #time = cacheSize + 1;
  #written = 0;
  #scan = 0;

  constructor(corners: Int32Array, vertexCount: number) {
    this.#corners = corners;
    this.#vertexCount = vertexCount;
    this.#ordered = new Int32Array(corners.length);
    this.#live = new Int32Array(vertexCount);
    this.#entered = new Int32Array(vertexCount);
    this.#isDone = new Uint8Array(corners.length / 3);
    this.#met = new Int32Array(corners.length);
    this.#firsts = new Int32Array(vertexCount + 1);
    this.#around = new Int32Array(corners.length);
    this.#listTriangles();
  }

  run(): Int32Array {
    for (let fan = 0; fan >= 0;) {
      const before = this.#metCount;
      this.#emitAround(fan);
      fan = this.#nextFan(before);
    }
    return this.#ordered;
  }

  #listTriangles(): void {
    const corners = this.#corners;
    const live = this.#live;
    const firsts = this.#firsts;
    for (const v of corners) live[v] = live[v]! + 1;
    for (let v = 0, sum = 0; v < this.#vertexCount; ++v) {
      sum += live[v]!;
      firsts[v + 1] = sum;
    }
    // Filled from the back, which leaves each list's place where it belongs.
    for (let t = this.#isDone.length - 1; t >= 0; --t) {
      for (let c = 3 * t + 2; c >= 3 * t; --c) {
        const place = firsts[corners[c]! + 1]! - 1;
        firsts[corners[c]! + 1] = place;
        this.#around[place] = t;
      }
    }
    firsts.copyWithin(0, 1);
    firsts[this.#vertexCount] = corners.length;
  }

  #emitAround(fan: number): void {
    const corners = this.#corners;
    const around = this.#around;
    const isDone = this.#isDone;
    for (let place = this.#firsts[fan]!, end = this.#firsts[fan + 1]!; place < end; ++place) {
      const t = around[place]!;
      if (isDone[t] === 1) continue;
      isDone[t] = 1;
      this.#emit(corners[3 * t]!);
      this.#emit(corners[3 * t + 1]!);
      this.#emit(corners[3 * t + 2]!);
    }
  }

  #emit(v: number): void {
    this.#ordered[this.#written++] = v;
    this.#met[this.#metCount++] = v;
    this.#live[v] = this.#live[v]! - 1;
    if (this.#time - this.#entered[v]! > cacheSize) this.#entered[v] = this.#time++;
  }

  /** Of the vertices met since, the one longest in the cache that will still be there when its fan is done. */
  #nextFan(since: number): number {
    const met = this.#met;
    const live = this.#live;
    let best = -1;
    let longest = -1;
    for (let place = since; place < this.#metCount; ++place) {
      const v = met[place]!;
      if (live[v] === 0) continue;
      const age = this.#time - this.#entered[v]!;
      const priority = age + 2 * live[v]! <= cacheSize ? age : 0;
      if (priority > longest) {
        longest = priority;
        best = v;
      }
    }
    return best >= 0 ? best : this.#leaveDeadEnd();
  }

  #leaveDeadEnd(): number {
    while (this.#metCount > 0) {
      const v = this.#met[--this.#metCount]!;
      if (this.#live[v]! > 0) return v;
    }
    for (; this.#scan < this.#vertexCount; ++this.#scan) if (this.#live[this.#scan]! > 0) return this.#scan;
    return -1;
  }
}
