// X3D's ElevationGrid (ISO/IEC 19775-1, 13.3.4): heights over a grid in x and z become quadrilaterals. The vertices
// and faces are those of src/import/x3d: vectors/tessellation/elevationGrid.json tests both.

import type { Corner, Surface, VertexData } from "./faces.ts";

/** The fields of an ElevationGrid node. */
export interface ElevationGridFields {
  readonly xDimension: number;
  readonly zDimension: number;
  readonly xSpacing: number;
  readonly zSpacing: number;
  /** Row by row, x first. */
  readonly height: readonly number[];
  readonly normalPerVertex: boolean;
  readonly colorPerVertex: boolean;
}

/**
 * Vertices row by row and a quadrilateral for each cell. `childData` has the attributes that the node's children give.
 * Undefined where there are too few heights or less than two rows or columns.
 */
export function elevationGrid(values: ElevationGridFields, childData: VertexData): Surface | undefined {
  const { xDimension: columns, zDimension: rows, xSpacing, zSpacing, height, normalPerVertex, colorPerVertex } = values;
  if (columns < 2 || rows < 2 || columns * rows > height.length) return undefined;
  const positions: number[] = [],
    texCoords: number[] = [];
  for (let z = 0; z < rows; ++z) {
    for (let x = 0; x < columns; ++x) {
      positions.push(xSpacing * x, height[z * columns + x] ?? 0, zSpacing * z);
      texCoords.push(x / (columns - 1), z / (rows - 1));
    }
  }
  const faces: Corner[][] = [];
  for (let z = 0; z + 1 < rows; ++z) {
    for (let x = 0; x + 1 < columns; ++x) {
      const [corner, face] = [z * columns + x, faces.length];
      faces.push(
        [corner, corner + columns, corner + columns + 1, corner + 1].map((position) => ({
          position,
          texCoord: position,
          normal: childData.normals.length === 0 ? -1 : normalPerVertex ? position : face,
          color: childData.colors.length === 0 ? -1 : colorPerVertex ? position : face,
        })),
      );
    }
  }
  return {
    data: { ...childData, positions, texCoords: childData.texCoords.length > 0 ? childData.texCoords : texCoords },
    faces,
  };
}
