// Decodes the connectivity of triangles, which grow from a boundary: the cut-border machine of Gumhold and Straßer,
// "Real time compression of triangle mesh connectivity", 1998, with vertices processed in the order of their discovery
// (docs/formats/compact.md, "Connectivity of triangles").

import { DecodeError } from "../decodeError.ts";
import type { Connectivity } from "./connectivity.ts";
import { unconnected } from "./connectivity.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { numberModelCount } from "./rangeDecoder.ts";

const degreeContexts = 12 * 12 * 8;
const makeModels = 0;
const closeModels = makeModels + degreeContexts;
const backModels = closeModels + degreeContexts;
const holeModels = backModels + degreeContexts;
const joinModel = holeModels + 4;
const oldModels = joinModel + 1;
const nodeModels = oldModels + 3;
const vertexModels = nodeModels + numberModelCount;
export const triangleModelCount = vertexModels + numberModelCount;

// A node is an occurrence of a vertex on the boundary. It also stands for the edge from the previous node to it. A node
// is known by the index of the first of its four fields in `#nodes`.
const nodeSize = 4;
const previousField = 1; // field 0 is the vertex
const nextField = 2;
const apexField = 3; // the corner opposite its edge, in the triangle behind it

/** Safe for untrusted bytes. Throws DecodeError. */
export function decodeTriangles(decoder: RangeDecoder, triangleCount: number, vertexCount: number): Connectivity {
  return new Conquest(decoder, triangleCount, vertexCount).run();
}

class Conquest {
  readonly #decoder: RangeDecoder;
  readonly #triangleCount: number;
  readonly #vertexCount: number;
  readonly #out: Connectivity;
  readonly #vertex: Int32Array;
  readonly #nodes: Int32Array;
  readonly #degrees: Int32Array;
  /** The indices of the next node (times `nodeSize`), triangle and vertex. */
  #node = 0;
  #triangle = 0;
  #newVertex = 0;

  constructor(decoder: RangeDecoder, triangleCount: number, vertexCount: number) {
    this.#decoder = decoder;
    this.#triangleCount = triangleCount;
    this.#vertexCount = vertexCount;
    const none = (count: number) => new Int32Array(count).fill(-1);
    this.#vertex = new Int32Array(3 * triangleCount);
    this.#out = {
      ...unconnected,
      vertex: this.#vertex,
      across: none(triangleCount),
      closing: none(triangleCount),
      ahead: none(vertexCount),
      behind: none(vertexCount),
      second: none(vertexCount),
    };
    this.#nodes = new Int32Array(3 * triangleCount * nodeSize);
    this.#degrees = new Int32Array(vertexCount);
  }

  run(): Connectivity {
    const nodes = this.#nodes;
    const fans = new Int32Array(2 * 3 * this.#triangleCount);
    let pivot = 0;
    let fanOffset = 0;
    while (this.#triangle < this.#triangleCount) {
      this.#decodeRoot();
      for (; pivot < this.#node; pivot += nodeSize) {
        while (this.#triangle < this.#triangleCount && nodes[pivot + previousField]! >= 0) this.#crossEdgeTo(pivot);
        fans[fanOffset++] = this.#triangle;
        fans[fanOffset++] = this.#node / nodeSize;
      }
    }
    if (this.#newVertex < this.#vertexCount)
      throw new DecodeError("malformed", "holds fewer vertices than its header states");
    return { ...this.#out, fans: fans.subarray(0, fanOffset) };
  }

  /** Decodes a triangle that shares no edge with the boundary. */
  #decodeRoot(): void {
    const corner = 3 * this.#triangle;
    const node = this.#node;
    const decoder = this.#decoder;
    const [a, b, c] = [0, 1, 2].map((i) => (decoder.bit(oldModels + i) === 1 ? this.#oldVertex() : this.#makeVertex()));
    this.#addTriangle(a!, b!, c!);
    for (let i = 0; i < 3; ++i) {
      this.#addNode(
        this.#vertex[corner + i]!,
        node + ((i + 2) % 3) * nodeSize,
        node + ((i + 1) % 3) * nodeSize,
        corner + ((i + 1) % 3),
      );
    }
  }

  /** Decodes what lies across the edge to node k: a triangle or a border. */
  #crossEdgeTo(k: number): void {
    const nodes = this.#nodes;
    const decoder = this.#decoder;
    const degrees = this.#degrees;
    const p = nodes[k + previousField]!;
    const next = nodes[k + nextField]!;
    const behind = nodes[p + previousField]!;
    const vk = nodes[k]!;
    const vp = nodes[p]!;
    const context =
      (Math.min(degrees[vk]!, 11) * 12 + Math.min(degrees[vp]!, 11)) * 8 +
      (next < 0 ? 0 : Math.min(degrees[nodes[next]!]!, 7));
    if (decoder.bit(makeModels + context) === 1) {
      const x = this.#makeVertex();
      if (next >= 0) this.#out.ahead[x] = nodes[next]!;
      if (behind >= 0) this.#out.behind[x] = nodes[behind]!;
      this.#insert(k, p, x);
    } else if (next >= 0 && decoder.bit(closeModels + context) === 1) {
      this.#close(k, p, next, behind);
    } else if (behind >= 0 && decoder.bit(backModels + context) === 1) {
      this.#back(k, p, behind);
    } else if (decoder.bit(holeModels + Number(next < 0) + 2 * Number(behind < 0)) === 1) {
      nodes[k + previousField] = -1;
      nodes[p + nextField] = -1;
    } else if (decoder.bit(joinModel) === 1) {
      this.#join(k, p);
    } else {
      this.#insert(k, p, this.#oldVertex());
    }
  }

  /** Adds a triangle whose third vertex becomes a new node between p and k. */
  #insert(k: number, p: number, x: number): void {
    const nodes = this.#nodes;
    const t = this.#triangle;
    const corner = 3 * t;
    this.#out.across[t] = nodes[k + apexField]!;
    this.#addTriangle(nodes[k]!, nodes[p]!, x);
    const node = this.#addNode(x, p, k, corner);
    nodes[p + nextField] = node;
    nodes[k + previousField] = node;
    nodes[k + apexField] = corner + 1;
  }

  /** Adds a triangle with the vertex of the next node; k leaves the boundary. */
  #close(k: number, p: number, next: number, behind: number): void {
    const nodes = this.#nodes;
    const t = this.#triangle;
    const corner = 3 * t;
    const { across, closing, second } = this.#out;
    const vk = nodes[k]!;
    const vp = nodes[p]!;
    const vn = nodes[next]!;
    const opposite = nodes[next + apexField]!;
    if (vp > vk && vp > vn && vp > this.#vertex[opposite]! && second[vp]! < 0) second[vp] = opposite;
    across[t] = nodes[k + apexField]!;
    closing[t] = opposite;
    this.#addTriangle(vk, vp, vn);
    nodes[k + previousField] = nodes[k + nextField] = -1;
    if (behind === next) {
      // the loop is closed
      nodes[p + previousField] = nodes[p + nextField] = -1;
      nodes[next + previousField] = nodes[next + nextField] = -1;
      return;
    }
    nodes[p + nextField] = next;
    nodes[next + previousField] = p;
    nodes[next + apexField] = corner;
  }

  /** Adds a triangle with the vertex of the node before p; p leaves the boundary. */
  #back(k: number, p: number, behind: number): void {
    const nodes = this.#nodes;
    const t = this.#triangle;
    const corner = 3 * t;
    this.#out.across[t] = nodes[k + apexField]!;
    this.#out.closing[t] = nodes[p + apexField]!;
    this.#addTriangle(nodes[k]!, nodes[p]!, nodes[behind]!);
    nodes[p + previousField] = nodes[p + nextField] = -1;
    nodes[behind + nextField] = k;
    nodes[k + previousField] = behind;
    nodes[k + apexField] = corner + 1;
  }

  /**
   * Adds a triangle with the vertex of a node elsewhere: a loop splits, or two loops become one. That node keeps the
   * boundary after it, a new node of the same vertex takes the boundary before it.
   */
  #join(k: number, p: number): void {
    const nodes = this.#nodes;
    const t = this.#triangle;
    const corner = 3 * t;
    const target = k + nodeSize * (1 + this.#decoder.number(nodeModels));
    if (target >= this.#node)
      throw new DecodeError("malformed", "names a node of the boundary that is not decoded yet");
    this.#out.across[t] = nodes[k + apexField]!;
    this.#addTriangle(nodes[k]!, nodes[p]!, nodes[target]!);
    const beforeTarget = nodes[target + previousField]!;
    const node = this.#addNode(nodes[target]!, beforeTarget, k, nodes[target + apexField]!);
    if (beforeTarget >= 0) nodes[beforeTarget + nextField] = node;
    nodes[target + previousField] = p;
    nodes[target + apexField] = corner;
    nodes[p + nextField] = target;
    nodes[k + previousField] = node;
    nodes[k + apexField] = corner + 1;
  }

  #addNode(vertex: number, previous: number, next: number, apex: number): number {
    const nodes = this.#nodes;
    const node = this.#node;
    nodes[node] = vertex;
    nodes[node + previousField] = previous;
    nodes[node + nextField] = next;
    nodes[node + apexField] = apex;
    this.#node = node + nodeSize;
    return node;
  }

  #addTriangle(a: number, b: number, c: number): void {
    const degrees = this.#degrees;
    const corner = 3 * this.#triangle;
    this.#vertex[corner] = a;
    this.#vertex[corner + 1] = b;
    this.#vertex[corner + 2] = c;
    degrees[a] = degrees[a]! + 1;
    degrees[b] = degrees[b]! + 1;
    degrees[c] = degrees[c]! + 1;
    this.#triangle += 1;
  }

  #makeVertex(): number {
    if (this.#newVertex >= this.#vertexCount)
      throw new DecodeError("malformed", "holds more vertices than its header states");
    return this.#newVertex++;
  }

  #oldVertex(): number {
    const vertex = this.#newVertex - 1 - this.#decoder.number(vertexModels);
    if (vertex < 0) throw new DecodeError("malformed", "names a vertex that is not decoded yet");
    return vertex;
  }
}
