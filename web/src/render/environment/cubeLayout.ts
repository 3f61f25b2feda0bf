// Where the sides of a cube map are in a picture that holds all six.

import type { DecodedImage } from "../../stage/decodedImage.ts";
import type { PanoramaSide } from "../../document/description.ts";

/** Left, top, width and height as shares of the picture; with negative sizes, the side is turned by half a turn. */
export type CubeArea = readonly [left: number, top: number, width: number, height: number];
export type CubeLayout = Readonly<Record<PanoramaSide, CubeArea>>;

/** Column and row of each side. */
type Cells = Readonly<Record<PanoramaSide, readonly [column: number, row: number]>>;

const cross: Cells = { top: [1, 0], left: [0, 1], front: [1, 1], right: [2, 1], back: [3, 1], bottom: [1, 2] };
const row: Cells = { right: [0, 0], left: [1, 0], top: [2, 0], bottom: [3, 0], front: [4, 0], back: [5, 0] };

function layoutOf(cells: Cells, columns: number, rows: number): CubeLayout {
  const area = ([column, row]: readonly [number, number]): CubeArea => [
    column / columns,
    row / rows,
    1 / columns,
    1 / rows,
  ];
  const { front, back, left, right, top, bottom } = cells;
  return {
    front: area(front),
    back: area(back),
    left: area(left),
    right: area(right),
    top: area(top),
    bottom: area(bottom),
  };
}

const upright = layoutOf({ ...cross, back: [1, 3] }, 3, 4);

/** By columns and rows. In an upright cross the back is below the bottom, upside down. */
const layouts: readonly (readonly [columns: number, rows: number, layout: CubeLayout])[] = [
  [4, 3, layoutOf(cross, 4, 3)],
  [3, 4, { ...upright, back: [2 / 3, 1, -1 / 3, -1 / 4] }],
  [6, 1, layoutOf(row, 6, 1)],
  [1, 6, layoutOf({ right: [0, 0], left: [0, 1], top: [0, 2], bottom: [0, 3], front: [0, 4], back: [0, 5] }, 1, 6)],
];

/**
 * The layout of a picture: a cross of 4 x 3 or 3 x 4 squares, or six of them in a row or a column in the order of
 * OpenGL's faces (right, left, top, bottom, front, back). Undefined for a picture of other proportions.
 */
export function cubeLayoutOf(width: number, height: number): CubeLayout | undefined {
  return layouts.find(([columns, rows]) => width > 0 && width * rows === height * columns)?.[2];
}

/**
 * Why a picture is no cube map, as the rest of a sentence; undefined for one that is, and for pictures of other roles.
 */
export function cubeMapProblemOf(role: string, { width, height }: DecodedImage): string | undefined {
  if (!role.endsWith("whole") || cubeLayoutOf(width, height)) return undefined;
  const pixels = `${width} x ${height} pixels`;
  return `is no cube map: ${pixels} are no cross of 4 x 3 or 3 x 4 squares, and no row or column of six`;
}
