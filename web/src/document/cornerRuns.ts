// Reads which corners the polygons, polylines and points of a geometry node have, of nodes that name vertices one by
// one.

import type { Corner, VertexArrays, VertexData } from "../tessellate/faces.ts";
import type { nodeFields, Values } from "./nodes.ts";

type Fields = Values<typeof nodeFields.InlineGeometry>;

/** Runs of corners: a polygon, polyline or point each. */
export type Runs = readonly (readonly Corner[])[];

type RunReader = (fields: Fields, data: VertexData) => Runs;

/** By the lower-case names of nodes. */
export const runReaders: Readonly<Record<string, RunReader>> = {
  indexedfaceset: indexedRuns,
  indexedlineset: indexedRuns,
  triangleset: byVertex((_, count) => tuplesOf(3, indicesTo(count))),
  indexedtriangleset: byVertex(({ index }) => tuplesOf(3, withoutNegatives(index))),
  quadset: byVertex((_, count) => tuplesOf(4, indicesTo(count))),
  indexedquadset: byVertex(({ index }) => tuplesOf(4, withoutNegatives(index))),
  trianglestripset: byVertex(({ stripCount }) => consecutiveRuns(stripCount).flatMap(strip)),
  indexedtrianglestripset: byVertex(({ index }) => runsBetweenNegatives(index).flatMap(strip)),
  trianglefanset: byVertex(({ fanCount }) => consecutiveRuns(fanCount).flatMap(fan)),
  indexedtrianglefanset: byVertex(({ index }) => runsBetweenNegatives(index).flatMap(fan)),
  lineset: byVertex(({ vertexCount }) => consecutiveRuns(vertexCount)),
  pointset: byVertex((_, count) => tuplesOf(1, indicesTo(count))),
};

/** What the runs of a node of this lower-case name are drawn as. */
export function primitiveOf(name: string): VertexArrays["primitive"] {
  if (name === "pointset") return "points";
  return name === "lineset" || name === "indexedlineset" ? "lines" : "triangles";
}

/** The runs of coordIndex between its -1s, with the indices of the other attributes (ISO/IEC 19775-1, 11.2.2.4). */
function indexedRuns(fields: Fields, data: VertexData): Runs {
  const { coordIndex, normalIndex, colorIndex, texCoordIndex } = fields;
  const runs: Corner[][] = [[]];
  const indexOf = (indices: readonly number[], perVertex: boolean, corner: number, position: number) => {
    const attributeIndex = perVertex ? corner : runs.length - 1;
    return indices.length > 0 ? (indices[attributeIndex] ?? -1) : perVertex ? position : attributeIndex;
  };
  coordIndex.forEach((position, corner) => {
    if (position < 0) {
      runs.push([]);
      return;
    }
    runs.at(-1)?.push({
      position,
      normal: data.normals.length > 0 ? indexOf(normalIndex, fields.normalPerVertex, corner, position) : -1,
      texCoord: data.texCoords.length > 0 ? indexOf(texCoordIndex, true, corner, position) : -1,
      color: data.colors.length > 0 ? indexOf(colorIndex, fields.colorPerVertex, corner, position) : -1,
    });
  });
  return runs;
}

/**
 * A reader of runs of vertices: the attributes of their corners are indexed by the vertex, or by the face.
 * `verticesOf` gets the number of positions.
 */
function byVertex(verticesOf: (fields: Fields, count: number) => readonly (readonly number[])[]): RunReader {
  return (fields, data) =>
    verticesOf(fields, data.positions.length / 3).map((run, face) =>
      run.map((position) => ({
        position,
        normal: data.normals.length === 0 ? -1 : fields.normalPerVertex ? position : face,
        texCoord: data.texCoords.length === 0 ? -1 : position,
        color: data.colors.length === 0 ? -1 : fields.colorPerVertex ? position : face,
      })),
    );
}

function indicesTo(count: number): number[] {
  return Array.from({ length: count }, (_, index) => index);
}

/** Whole tuples of successive vertices; the rest is left out. */
function tuplesOf(size: number, vertices: readonly number[]): number[][] {
  return indicesTo(Math.floor(vertices.length / size)).map((tuple) => vertices.slice(size * tuple, size * (tuple + 1)));
}

/** Runs of consecutive vertices of these lengths. */
function consecutiveRuns(counts: readonly number[]): number[][] {
  let next = 0;
  return counts.map((count) => indicesTo(Math.max(count, 0)).map(() => next++));
}

function withoutNegatives(index: readonly number[]): number[] {
  return index.filter((vertex) => vertex >= 0);
}

function runsBetweenNegatives(index: readonly number[]): number[][] {
  const runs: number[][] = [[]];
  for (const vertex of index) {
    if (vertex < 0) runs.push([]);
    else runs.at(-1)?.push(vertex);
  }
  return runs;
}

/** The triangles of a fan. */
function fan(run: readonly number[]): number[][] {
  return run.slice(2).map((last, i) => [run[0] ?? 0, run[i + 1] ?? 0, last]);
}

/** The triangles of a strip, in its orientation: every other one has two corners exchanged. */
function strip(run: readonly number[]): number[][] {
  return run.slice(2).map((last, i) => {
    const [first, second] = [run[i] ?? 0, run[i + 1] ?? 0];
    return i % 2 === 0 ? [first, second, last] : [first, last, second];
  });
}
