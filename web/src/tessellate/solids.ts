// X3D's Box, Sphere, Cylinder and Cone (ISO/IEC 19775-1, 13.3) as polygons with normals and texture coordinates.

import type { Corner, VertexData } from "./faces.ts";

/** Segments around the axis of a round solid: steps of 7.5 degrees. */
const segmentCount = 48;

export interface Solid {
  readonly data: VertexData;
  readonly faces: Corner[][];
}

interface SolidCorner {
  readonly position: readonly number[];
  readonly normal: readonly number[];
  readonly texCoord: readonly [number, number];
}

class SolidBuilder {
  readonly #positions: number[] = [];
  readonly #normals: number[] = [];
  readonly #texCoords: number[] = [];
  readonly #faces: Corner[][] = [];

  /** Corners run counter-clockwise as seen from outside. */
  addFace(...corners: SolidCorner[]): void {
    this.#faces.push(
      corners.map(({ position, normal, texCoord }) => {
        const index = this.#positions.length / 3;
        this.#positions.push(...position);
        this.#normals.push(...normal);
        this.#texCoords.push(...texCoord);
        return { position: index, normal: index, texCoord: index, color: -1 };
      }),
    );
  }

  get solid(): Solid {
    const data = {
      positions: this.#positions,
      normals: this.#normals,
      texCoords: this.#texCoords,
      colors: [],
      colorComponents: 3 as const,
    };
    return { data, faces: this.#faces };
  }
}

/** A box's sides: the normal, and the directions of a texture's s and t axes (ISO/IEC 19775-1, 13.3.1). */
const sides = [
  [
    [0, 0, 1],
    [1, 0, 0],
    [0, 1, 0],
  ],
  [
    [0, 0, -1],
    [-1, 0, 0],
    [0, 1, 0],
  ],
  [
    [1, 0, 0],
    [0, 0, -1],
    [0, 1, 0],
  ],
  [
    [-1, 0, 0],
    [0, 0, 1],
    [0, 1, 0],
  ],
  [
    [0, 1, 0],
    [1, 0, 0],
    [0, 0, -1],
  ],
  [
    [0, -1, 0],
    [1, 0, 0],
    [0, 0, 1],
  ],
] as const;

export function box(size: readonly [number, number, number]): Solid {
  const builder = new SolidBuilder();
  for (const [normal, right, up] of sides) {
    const corner = (u: 0 | 1, v: 0 | 1): SolidCorner => ({
      position: size.map(
        (edge, axis) =>
          (edge / 2) * ((normal[axis] ?? 0) + (2 * u - 1) * (right[axis] ?? 0) + (2 * v - 1) * (up[axis] ?? 0)),
      ),
      normal,
      texCoord: [u, v],
    });
    builder.addFace(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
  }
  return builder.solid;
}

/** The unit direction of a segment in the xz plane: from -z on, counter-clockwise as seen from above. */
function directionOf(segment: number): readonly [x: number, z: number] {
  const phi = (2 * Math.PI * segment) / segmentCount;
  return [-Math.sin(phi), -Math.cos(phi)];
}

export function sphere(radius: number): Solid {
  const builder = new SolidBuilder();
  const rings = segmentCount / 2;
  const cornerAt = (ring: number, segment: number): SolidCorner => {
    const theta = (Math.PI * ring) / rings;
    const [x, z] = directionOf(segment);
    const normal = [Math.sin(theta) * x, Math.cos(theta), Math.sin(theta) * z];
    return {
      position: normal.map((value) => value * radius),
      normal,
      texCoord: [segment / segmentCount, 1 - ring / rings],
    };
  };
  for (let ring = 0; ring < rings; ++ring) {
    for (let segment = 0; segment < segmentCount; ++segment) {
      const quad = [
        cornerAt(ring, segment),
        cornerAt(ring + 1, segment),
        cornerAt(ring + 1, segment + 1),
        cornerAt(ring, segment + 1),
      ];
      if (ring === 0) quad.pop(); // both are the pole
      if (ring === rings - 1) quad.splice(2, 1);
      builder.addFace(...quad);
    }
  }
  return builder.solid;
}

export interface CylinderSurfaces {
  readonly side: boolean;
  readonly top: boolean;
  readonly bottom: boolean;
}

/** A cylinder, or a cone where `topRadius` is 0, along y, its center at the origin. */
export function cylinderOrCone(
  topRadius: number,
  bottomRadius: number,
  height: number,
  surfaces: CylinderSurfaces,
): Solid {
  const builder = new SolidBuilder();
  const slope = (bottomRadius - topRadius) / height;
  const normalLength = Math.hypot(1, slope);
  const [top, bottom] = [height / 2, -height / 2];
  const sideCorner = (segment: number, y: number, radius: number): SolidCorner => {
    const [x, z] = directionOf(segment);
    return {
      position: [x * radius, y, z * radius],
      normal: [x / normalLength, slope / normalLength, z / normalLength],
      texCoord: [segment / segmentCount, y / height + 0.5],
    };
  };
  // Caps show the largest circle inside the texture.
  const capCorner = (segment: number, y: number, radius: number, facing: 1 | -1): SolidCorner => {
    const [x, z] = radius > 0 ? directionOf(segment) : [0, 0];
    return {
      position: [x * radius, y, z * radius],
      normal: [0, facing, 0],
      texCoord: [0.5 + x / 2, 0.5 - (facing * z) / 2],
    };
  };
  for (let segment = 0; segment < segmentCount; ++segment) {
    if (surfaces.side) {
      const quad = [
        sideCorner(segment, bottom, bottomRadius),
        sideCorner(segment + 1, bottom, bottomRadius),
        sideCorner(segment + 1, top, topRadius),
      ];
      builder.addFace(...quad, ...(topRadius > 0 ? [sideCorner(segment, top, topRadius)] : []));
    }
    if (surfaces.top && topRadius > 0)
      builder.addFace(
        capCorner(0, top, 0, 1),
        capCorner(segment, top, topRadius, 1),
        capCorner(segment + 1, top, topRadius, 1),
      );
    if (surfaces.bottom)
      builder.addFace(
        capCorner(0, bottom, 0, -1),
        capCorner(segment + 1, bottom, bottomRadius, -1),
        capCorner(segment, bottom, bottomRadius, -1),
      );
  }
  return builder.solid;
}
