// Where feet can go: the map of heights around a walker, flooded from where he
// stands. From one cell to the next one climbs no higher than a step, and falls
// however deep. What the flood does not reach stands in the way.

import type { HeightMap, GroundSamples } from "./groundSamples.ts";

/** NavigationInfo's avatarSize (ISO/IEC 19775-1, 23.4.4), lengths in the scene. */
export interface Avatar {
  /** That is kept from things. */
  readonly radius: number;
  /** Of the eye above the floor. */
  readonly height: number;
  /** What is no higher is climbed. */
  readonly step: number;
}

/** A place on the map. */
export interface GroundPoint {
  readonly x: number;
  readonly z: number;
}

export class WalkableGround {
  readonly #map: HeightMap;
  readonly #reach: number;
  readonly #radius: number;
  /** Of each cell: 1 where feet can come. */
  readonly #isReached: Uint8Array;
  /** (x, z), one after the other, of what is in the way. */
  readonly #obstacles: Float32Array;
  /** There is no floor under him, now, so that no edge of one holds him back. */
  readonly isHovering: boolean;

  /** For somebody whose eye is in the middle of the map, `reach` from its edges. */
  constructor({ floor: { cells, heights }, walls }: GroundSamples, reach: number, { radius, height, step }: Avatar) {
    const floor = { cells, heights: withoutCracks(cells, heights) };
    this.#map = floor;
    this.#reach = reach;
    this.#radius = radius;
    const start = this.#nearestFloor({ x: 0, z: 0 });
    this.isHovering = start === undefined;
    this.#isReached = this.isHovering ? reachedInAir(floor, step - height) : reachedFrom(floor, start ?? 0, step);
    this.#obstacles = Float32Array.from([...walls, ...this.#cliffs()]);
  }

  /** Of the floor that carries somebody there: the highest under his feet. Undefined where there is none. */
  floorAt(place: GroundPoint): number | undefined {
    let highest = -Infinity;
    for (const cell of this.#cellsAround(place)) {
      if (this.#isReached[cell] === 1) highest = Math.max(highest, this.#map.heights[cell] ?? -Infinity);
    }
    return highest === -Infinity ? undefined : highest;
  }

  /** How far the nearest thing in the way is. */
  clearanceAt({ x, z }: GroundPoint): number {
    let least = Infinity;
    for (let at = 0; at < this.#obstacles.length; at += 2) {
      least = Math.min(least, Math.hypot(x - (this.#obstacles[at] ?? 0), z - (this.#obstacles[at + 1] ?? 0)));
    }
    return least;
  }

  /** The same place, moved out of what it is too near to; one slides along walls by this. */
  clearOf({ x, z }: GroundPoint): GroundPoint {
    for (let at = 0; at < this.#obstacles.length; at += 2) {
      const [dx, dz] = [x - (this.#obstacles[at] ?? 0), z - (this.#obstacles[at + 1] ?? 0)];
      const distance = Math.hypot(dx, dz);
      if (distance >= this.#radius || distance === 0) continue;
      x += dx * (this.#radius / distance - 1);
      z += dz * (this.#radius / distance - 1);
    }
    return { x, z };
  }

  /** So far from the map's edges that all around it is known. */
  isKnown({ x, z }: GroundPoint): boolean {
    return Math.max(Math.abs(x), Math.abs(z)) <= this.#reach - this.#radius;
  }

  /** The cells that a body stands over, at least the one in its middle. */
  *#cellsAround({ x, z }: GroundPoint): Generator<number> {
    const { cells } = this.#map;
    const size = (2 * this.#reach) / cells;
    const [column, row] = [this.#lineOf(x), this.#lineOf(z)];
    const wide = Math.floor(this.#radius / size);
    for (let down = Math.max(row - wide, 0); down <= Math.min(row + wide, cells - 1); ++down) {
      for (let along = Math.max(column - wide, 0); along <= Math.min(column + wide, cells - 1); ++along) {
        if (Math.hypot(along - column, down - row) * size <= this.#radius) yield down * cells + along;
      }
    }
  }

  #lineOf(place: number): number {
    const { cells } = this.#map;
    return Math.min(Math.max(Math.floor(((place / this.#reach + 1) / 2) * cells), 0), cells - 1);
  }

  /** The cell under a body's middle, or the nearest that it stands over. */
  #nearestFloor(place: GroundPoint): number | undefined {
    const { cells, heights } = this.#map;
    const [column, row] = [this.#lineOf(place.x), this.#lineOf(place.z)];
    const distance = (cell: number) => Math.hypot((cell % cells) - column, Math.floor(cell / cells) - row);
    const floors = Array.from(this.#cellsAround(place)).filter((cell) => (heights[cell] ?? -Infinity) > -Infinity);
    return floors.sort((a, b) => distance(a) - distance(b))[0];
  }

  /** Places half way from cells that are reached to those beside them that are not: somewhere there something rises. */
  #cliffs(): number[] {
    const { cells, heights } = this.#map;
    const placeOf = (line: number) => ((2 * line + 1) / cells - 1) * this.#reach;
    const places: number[] = [];
    for (let cell = 0; cell < heights.length; ++cell) {
      if (this.#isReached[cell] === 1 || heights[cell] === -Infinity) continue;
      forNeighbours(cell, cells, (next) => {
        if (this.#isReached[next] !== 1) return;
        places.push(
          placeOf(((cell % cells) + (next % cells)) / 2),
          placeOf((Math.floor(cell / cells) + Math.floor(next / cells)) / 2),
        );
      });
    }
    return places;
  }
}

/** Between two pieces of floor there may be a cell in which neither is seen: it gets the lower one's height. */
function withoutCracks(cells: number, heights: Float32Array): Float32Array {
  return heights.map((height, cell) => {
    if (height !== -Infinity) return height;
    let [floors, lowest] = [0, Infinity];
    forNeighbours(cell, cells, (next) => {
      const beside = heights[next] ?? height;
      if (beside === -Infinity) return;
      floors += 1;
      lowest = Math.min(lowest, beside);
    });
    return floors > 1 ? lowest : height;
  });
}

/** Who hovers comes over everything that is lower. */
function reachedInAir({ heights }: HeightMap, highest: number): Uint8Array {
  return Uint8Array.from(heights, (height) => (height <= highest ? 1 : 0));
}

function reachedFrom({ cells, heights }: HeightMap, start: number, step: number): Uint8Array {
  const reached = new Uint8Array(heights.length);
  const waiting = [start];
  reached[start] = 1;
  for (let cell = waiting.pop(); cell !== undefined; cell = waiting.pop()) {
    const highest = (heights[cell] ?? 0) + step;
    forNeighbours(cell, cells, (next) => {
      const height = heights[next] ?? -Infinity;
      if (reached[next] === 1 || height === -Infinity || height > highest) return;
      reached[next] = 1;
      waiting.push(next);
    });
  }
  return reached;
}

function forNeighbours(cell: number, cells: number, visit: (neighbour: number) => void): void {
  const column = cell % cells;
  if (column > 0) visit(cell - 1);
  if (column < cells - 1) visit(cell + 1);
  if (cell >= cells) visit(cell - cells);
  if (cell < cells * (cells - 1)) visit(cell + cells);
}
