// The geometry of a live stream: what the document states, completed by what the stream states.

import type { AttributeDescription, Draw, GeometryDescription, PatchDescription } from "../../document/description.ts";
import { byVertexRole } from "../../stage/attributeRows.ts";
import type { StreamState } from "./streamState.ts";

/**
 * The geometry with the lattice, the box, the vertices and the attributes of the stream. Where the document has no
 * index, a grid is a surface unless the document draws points; all other vertices are points.
 */
export function withStreamState(geometry: GeometryDescription, state: StreamState): GeometryDescription {
  const { positionBits, origin, step, vertices, columns, box } = state;
  const [stated] = geometry.patches;
  if (stated === undefined) throw new RangeError("a stream has one patch");
  const planeCount = Math.ceil(positionBits / 8);
  // Coordinates are stored integers of whole bytes, whose largest value is the upper side of the box.
  const edge = step * (256 ** planeCount - 1);
  const rows = columns > 0 ? vertices / columns : 0;
  const areStatedPoints = stated.draws.some(({ primitive }) => primitive === "points");
  const hasGrid = stated.index === undefined && !areStatedPoints && columns > 1 && rows > 1;
  const grid = hasGrid ? ({ kind: stated.grid?.kind ?? "geometryImage", columns, rows } as const) : undefined;
  const coord = stated.coord[0];
  const planes = (count: number) => Array.from({ length: count }, () => coord).filter((plane) => plane !== undefined);
  const value = geometry.value && withRange(geometry.value, state);
  const streamed: Partial<PatchDescription> = {
    ...(state.normalBits > 0 && { normal: undefined }),
    ...(state.colorComponents > 0 && { color: undefined }),
  };
  return {
    ...geometry,
    positionBits: 0,
    position: [origin[0] + edge / 2, origin[1] + edge / 2, origin[2] + edge / 2],
    size: [edge, edge, edge],
    colorComponents: state.colorComponents === 4 ? 4 : state.colorComponents === 3 ? 3 : geometry.colorComponents,
    value,
    patches: [
      {
        ...stated,
        ...(stated.index === undefined &&
          byVertexRole((role) => (role.startsWith("texCoord") ? stated[role] : undefined))),
        ...streamed,
        box,
        vertexCount: vertices,
        draws: stated.index === undefined ? drawsOf(grid, vertices) : stated.draws,
        implicitWidth: stated.index === undefined ? columns || Math.min(vertices, 1024) : stated.implicitWidth,
        grid,
        coord: planes(planeCount),
        value: value === undefined ? [] : planes(Math.ceil(state.valueBits / 8)),
      },
    ],
  };
}

function drawsOf(grid: PatchDescription["grid"], vertices: number): readonly Draw[] {
  if (grid === undefined) return [{ primitive: "points", count: vertices }];
  const cellsAcross = grid.kind === "sculpt" ? grid.columns : grid.columns - 1;
  return [{ primitive: "triangles", count: 6 * cellsAcross * (grid.rows - 1) }];
}

/** Undefined where the stream has no values. */
function withRange(value: AttributeDescription, state: StreamState): AttributeDescription | undefined {
  if (state.valueComponents === 0) return undefined;
  // Values fill their bits, images whole bytes.
  const stretch = (256 ** Math.ceil(state.valueBits / 8) - 1) / (2 ** state.valueBits - 1);
  return {
    ...value,
    components: state.valueComponents as AttributeDescription["components"],
    bits: 8 * Math.ceil(state.valueBits / 8),
    min: state.valueRange.map(([min]) => min),
    size: state.valueRange.map(([min, max]) => (max - min) * stretch),
  };
}
