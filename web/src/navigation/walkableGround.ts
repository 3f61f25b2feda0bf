// The ground that a walking avatar can reach: a flood fill of the height map from the avatar's cell. From one cell to
// the next the avatar climbs at most a step, and falls any depth. Cells that the fill does not reach are obstacles.

import type { HeightMap, GroundSamples } from "./groundSamples.ts";

/** NavigationInfo's avatarSize (ISO/IEC 19775-1, 23.4.4), lengths in scene units. */
export interface Avatar {
  /** The distance kept from obstacles. */
  readonly radius: number;
  /** The height of the eye above the floor. */
  readonly height: number;
  /** The greatest height that the avatar climbs. */
  readonly step: number;
}

/** A position in the height map, in its frame. */
export interface GroundPoint {
  readonly x: number;
  readonly z: number;
}

export class WalkableGround {
  readonly #map: HeightMap;
  readonly #range: number;
  readonly #radius: number;
  /** By cell: 1 where the avatar can stand. */
  readonly #isReachable: Uint8Array;
  /** x and z of each obstacle point. */
  readonly #obstacles: Float32Array;
  /** Whether there is no floor below the avatar; then the edges of floors do not stop it. */
  readonly isHovering: boolean;

  /** The avatar's eye is at the center of the map, which extends `range` to each side. */
  constructor(
    { floor: { cellsPerSide, heights }, walls }: GroundSamples,
    range: number,
    { radius, height, step }: Avatar,
  ) {
    const floor = { cellsPerSide, heights: withoutCracks(cellsPerSide, heights) };
    this.#map = floor;
    this.#range = range;
    this.#radius = radius;
    const start = this.#nearestFloor({ x: 0, z: 0 });
    this.isHovering = start === undefined;
    this.#isReachable = this.isHovering ? reachableInAir(floor, step - height) : reachableFrom(floor, start ?? 0, step);
    this.#obstacles = Float32Array.from([...walls, ...this.#cliffs()]);
  }

  /** The height of the highest reachable cell below the avatar; undefined where there is none. */
  floorAt(point: GroundPoint): number | undefined {
    let highest = -Infinity;
    for (const cell of this.#cellsBelow(point)) {
      if (this.#isReachable[cell] === 1) highest = Math.max(highest, this.#map.heights[cell] ?? -Infinity);
    }
    return highest === -Infinity ? undefined : highest;
  }

  /** The distance to the nearest obstacle. */
  clearanceAt({ x, z }: GroundPoint): number {
    let min = Infinity;
    for (let i = 0; i < this.#obstacles.length; i += 2) {
      min = Math.min(min, Math.hypot(x - (this.#obstacles[i] ?? 0), z - (this.#obstacles[i + 1] ?? 0)));
    }
    return min;
  }

  /** The point moved out of the obstacles that it is too near to, which makes the avatar slide along walls. */
  clearOf({ x, z }: GroundPoint): GroundPoint {
    for (let i = 0; i < this.#obstacles.length; i += 2) {
      const [dx, dz] = [x - (this.#obstacles[i] ?? 0), z - (this.#obstacles[i + 1] ?? 0)];
      const distance = Math.hypot(dx, dz);
      if (distance >= this.#radius || distance === 0) continue;
      x += dx * (this.#radius / distance - 1);
      z += dz * (this.#radius / distance - 1);
    }
    return { x, z };
  }

  /** Whether the map covers everything within the avatar's radius of the point. */
  isCovered({ x, z }: GroundPoint): boolean {
    return Math.max(Math.abs(x), Math.abs(z)) <= this.#range - this.#radius;
  }

  /** The cells within the avatar's radius, which include the one below its center. */
  *#cellsBelow({ x: centerX, z: centerZ }: GroundPoint): Generator<number> {
    const { cellsPerSide } = this.#map;
    const size = (2 * this.#range) / cellsPerSide;
    const [column, row] = [this.#cellIndexOf(centerX), this.#cellIndexOf(centerZ)];
    const radius = Math.floor(this.#radius / size);
    for (let z = Math.max(row - radius, 0); z <= Math.min(row + radius, cellsPerSide - 1); ++z) {
      for (let x = Math.max(column - radius, 0); x <= Math.min(column + radius, cellsPerSide - 1); ++x) {
        if (Math.hypot(x - column, z - row) * size <= this.#radius) yield z * cellsPerSide + x;
      }
    }
  }

  #cellIndexOf(coordinate: number): number {
    const { cellsPerSide } = this.#map;
    return Math.min(Math.max(Math.floor(((coordinate / this.#range + 1) / 2) * cellsPerSide), 0), cellsPerSide - 1);
  }

  /** The cell with floor nearest to the avatar's center among those below it. */
  #nearestFloor(point: GroundPoint): number | undefined {
    const { cellsPerSide, heights } = this.#map;
    const [column, row] = [this.#cellIndexOf(point.x), this.#cellIndexOf(point.z)];
    const distance = (cell: number) =>
      Math.hypot((cell % cellsPerSide) - column, Math.floor(cell / cellsPerSide) - row);
    const floors = Array.from(this.#cellsBelow(point)).filter((cell) => (heights[cell] ?? -Infinity) > -Infinity);
    return floors.sort((a, b) => distance(a) - distance(b))[0];
  }

  /** Points half way between reachable cells and unreachable neighbors, where something rises. */
  #cliffs(): number[] {
    const { cellsPerSide, heights } = this.#map;
    const coordinateOf = (index: number) => ((2 * index + 1) / cellsPerSide - 1) * this.#range;
    const points: number[] = [];
    for (let cell = 0; cell < heights.length; ++cell) {
      if (this.#isReachable[cell] === 1 || heights[cell] === -Infinity) continue;
      forNeighbors(cell, cellsPerSide, (next) => {
        if (this.#isReachable[next] !== 1) return;
        points.push(
          coordinateOf(((cell % cellsPerSide) + (next % cellsPerSide)) / 2),
          coordinateOf((Math.floor(cell / cellsPerSide) + Math.floor(next / cellsPerSide)) / 2),
        );
      });
    }
    return points;
  }
}

/**
 * Fills single empty cells between floors, where the depth image shows neither floor, with the lower floor's height.
 */
function withoutCracks(cellsPerSide: number, heights: Float32Array): Float32Array {
  return heights.map((height, cell) => {
    if (height !== -Infinity) return height;
    let [floorCount, lowest] = [0, Infinity];
    forNeighbors(cell, cellsPerSide, (next) => {
      const neighborHeight = heights[next] ?? height;
      if (neighborHeight === -Infinity) return;
      floorCount += 1;
      lowest = Math.min(lowest, neighborHeight);
    });
    return floorCount > 1 ? lowest : height;
  });
}

/** A hovering avatar moves over every cell that is low enough. */
function reachableInAir({ heights }: HeightMap, highest: number): Uint8Array {
  return Uint8Array.from(heights, (height) => (height <= highest ? 1 : 0));
}

function reachableFrom({ cellsPerSide, heights }: HeightMap, start: number, step: number): Uint8Array {
  const isReachable = new Uint8Array(heights.length);
  const open = [start];
  isReachable[start] = 1;
  for (let cell = open.pop(); cell !== undefined; cell = open.pop()) {
    const highest = (heights[cell] ?? 0) + step;
    forNeighbors(cell, cellsPerSide, (next) => {
      const height = heights[next] ?? -Infinity;
      if (isReachable[next] === 1 || height === -Infinity || height > highest) return;
      isReachable[next] = 1;
      open.push(next);
    });
  }
  return isReachable;
}

function forNeighbors(cell: number, cellsPerSide: number, visit: (neighbor: number) => void): void {
  const column = cell % cellsPerSide;
  if (column > 0) visit(cell - 1);
  if (column < cellsPerSide - 1) visit(cell + 1);
  if (cell >= cellsPerSide) visit(cell - cellsPerSide);
  if (cell < cellsPerSide * (cellsPerSide - 1)) visit(cell + cellsPerSide);
}
