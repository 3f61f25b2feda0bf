// Patches whose images are grids of vertices: height maps, geometry images, sculpted prims. The tool reads and refuses
// the same in src/documents/grid_reader.cpp.

import type { GridPart } from "../stage/stage.ts";
import type { MeshMode, PatchDescription } from "./description.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";

/** Columns and rows of one image. */
const maxImageEdge = 4096;

/** Columns and rows of a height map in several images. */
const maxHeightMapEdge = 65536;

/** The patches with the vertices and triangles of their grids. Throws UnreadableGeometry for sizes without a surface. */
export function withGrids(patches: readonly PatchDescription[], kind: MeshMode): readonly PatchDescription[] {
  if (kind === "sig") return patches;
  patches.forEach(checkSize);
  if (kind !== "heightMap") return patches.map((patch) => withGrid(patch, kind));
  patches.forEach(checkOrigin);
  const columns = Math.max(...patches.map((patch) => patch.gridOrigin[0] + patch.implicitWidth));
  const rows = Math.max(...patches.map((patch) => patch.gridOrigin[1] + patch.implicitHeight));
  if (Math.max(columns, rows) > maxHeightMapEdge)
    throw new UnreadableGeometry(`a height map has more than ${maxHeightMapEdge} columns or rows`);
  return patches.map((patch) => {
    const [column, row] = patch.gridOrigin;
    return withGrid(patch, kind, { column, row, columns, rows });
  });
}

function checkSize({ implicitWidth: columns, implicitHeight: rows }: PatchDescription): void {
  if (Math.max(columns, rows) > maxImageEdge)
    throw new UnreadableGeometry(`a grid has more than ${maxImageEdge} columns or rows`);
  if (columns < 2 || rows < 2) throw new UnreadableGeometry(`a grid of ${columns} x ${rows} vertices has no surface`);
}

function checkOrigin({ gridOrigin }: PatchDescription): void {
  if (!gridOrigin.every((start) => start >= 0 && start < maxHeightMapEdge && Number.isInteger(start)))
    throw new UnreadableGeometry("gridOrigin is no column and row");
}

function withGrid(patch: PatchDescription, kind: Exclude<MeshMode, "sig">, part?: GridPart): PatchDescription {
  const { implicitWidth: columns, implicitHeight: rows } = patch;
  const cells = (kind === "sculpt" ? columns : columns - 1) * (rows - 1);
  return {
    ...patch,
    index: undefined,
    vertexCount: columns * rows,
    draws: [{ primitive: "triangles", count: 6 * cells }],
    grid: { kind, columns, rows, part },
  };
}
