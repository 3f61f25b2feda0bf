// Triangles in an order in which the GPU finds most of their vertices transformed
// already: Sander, Nehab and Barczak, "Fast triangle reordering for vertex locality
// and reduced overdraw", 2007. Fans around one vertex after the other, the next
// among those that are still in the cache. Linear time.

/** Vertices that a GPU remembers, at least. Larger caches lose little by it. */
const cacheSize = 16;

/** Corners of triangles over vertices 0 … vertexCount - 1, in their new order; each triangle keeps its turn. */
export function orderForVertexCache(corners: Int32Array, vertexCount: number): Int32Array {
  const { firsts, around } = trianglesAround(corners, vertexCount);
  const ordered = new Int32Array(corners.length);
  const isDone = new Uint8Array(corners.length / 3);
  // Per vertex: triangles that are still to come, and when it entered the cache.
  const live = new Int32Array(vertexCount);
  for (let v = 0; v < vertexCount; ++v) live[v] = firsts[v + 1]! - firsts[v]!;
  const entered = new Int32Array(vertexCount);
  let time = cacheSize + 1;
  let written = 0;
  // Where to go on when the cache has nothing to offer: back along what came into it, then from the first vertex on.
  const came = new Int32Array(corners.length);
  let cameCount = 0;
  let scan = 0;
  for (let fan = 0; written < ordered.length;) {
    const begin = written;
    for (let place = firsts[fan]!, end = firsts[fan + 1]!; place < end; ++place) {
      const t = around[place]!;
      if (isDone[t] === 1) continue;
      isDone[t] = 1;
      for (let c = 3 * t; c < 3 * t + 3; ++c) {
        const v = corners[c]!;
        ordered[written++] = v;
        live[v] = live[v]! - 1;
        if (time - entered[v]! <= cacheSize) continue;
        entered[v] = time++;
        came[cameCount++] = v;
      }
    }
    // Of the vertices met, the one longest in the cache that will still be there when its fan is done.
    let longest = -1;
    for (let place = begin; place < written; ++place) {
      const v = ordered[place]!;
      const left = live[v]!;
      if (left === 0) continue;
      const age = time - entered[v]!;
      const priority = age + 2 * left <= cacheSize ? age : 0;
      if (priority > longest) {
        longest = priority;
        fan = v;
      }
    }
    if (longest >= 0) continue;
    while (cameCount > 0 && live[came[cameCount - 1]!] === 0) --cameCount;
    while (cameCount === 0 && scan < vertexCount && live[scan] === 0) ++scan;
    fan = cameCount > 0 ? came[cameCount - 1]! : scan;
  }
  return ordered;
}

/** The triangles around vertex v are `around` from `firsts[v]` on. */
function trianglesAround(corners: Int32Array, vertexCount: number): { firsts: Int32Array; around: Int32Array } {
  // Counted two places further, then summed and filled one place further, which leaves each list's place where it belongs.
  const firsts = new Int32Array(vertexCount + 2);
  for (const v of corners) firsts[v + 2] = firsts[v + 2]! + 1;
  for (let v = 2; v < firsts.length; ++v) firsts[v] = firsts[v]! + firsts[v - 1]!;
  const around = new Int32Array(corners.length);
  for (let t = 0; 3 * t < corners.length; ++t) {
    for (let c = 3 * t; c < 3 * t + 3; ++c) {
      const place = firsts[corners[c]! + 1]!;
      around[place] = t;
      firsts[corners[c]! + 1] = place + 1;
    }
  }
  return { firsts, around };
}
