// X3D's Box, Sphere, Cylinder and Cone (ISO/IEC 19775-1, 13.3) as faces with normals.

import type { Corner, VertexData } from "./facets.ts";

/** Of round ones, around their axis; a whole circle in steps of 7.5 degrees. */
const segments = 48;

export interface Solid {
  readonly data: VertexData;
  readonly faces: Corner[][];
}

class SolidBuilder {
  readonly #positions: number[] = [];
  readonly #normals: number[] = [];
  readonly #faces: Corner[][] = [];

  /** Corners against the clock as seen from outside, each with its normal. */
  addFace(...corners: (readonly [position: readonly number[], normal: readonly number[]])[]): void {
    this.#faces.push(corners.map(([position, normal]) => {
      const number = this.#positions.length / 3;
      this.#positions.push(...position);
      this.#normals.push(...normal);
      return { position: number, normal: number, texCoord: -1, color: -1 };
    }));
  }

  get solid(): Solid {
    return { data: { positions: this.#positions, normals: this.#normals, texCoords: [], colors: [], colorComponents: 3 }, faces: this.#faces };
  }
}

export function box([x, y, z]: readonly [number, number, number]): Solid {
  const builder = new SolidBuilder();
  const half = [x / 2, y / 2, z / 2];
  for (const axis of [0, 1, 2]) {
    for (const side of [-1, 1]) {
      const [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
      const normal = [0, 0, 0];
      normal[axis] = side;
      const corner = (u: number, v: number) => {
        const position = [0, 0, 0];
        position[axis] = side * (half[axis] ?? 0);
        position[b] = side * u * (half[b] ?? 0); // mirrored on the other side, so that both face outwards
        position[c] = v * (half[c] ?? 0);
        return [position, normal] as const;
      };
      builder.addFace(corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
    }
  }
  return builder.solid;
}

export function sphere(radius: number): Solid {
  const builder = new SolidBuilder();
  const rings = segments / 2;
  const at = (ring: number, segment: number) => {
    const [theta, phi] = [Math.PI * ring / rings, 2 * Math.PI * segment / segments];
    const normal = [Math.sin(theta) * Math.sin(phi), Math.cos(theta), Math.sin(theta) * Math.cos(phi)];
    return [normal.map((value) => value * radius), normal] as const;
  };
  for (let ring = 0; ring < rings; ++ring) {
    for (let segment = 0; segment < segments; ++segment) {
      const quad = [at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1), at(ring, segment + 1)];
      if (ring === 0) quad.pop(); // both are the pole
      if (ring === rings - 1) quad.splice(2, 1);
      builder.addFace(...quad);
    }
  }
  return builder.solid;
}

export interface RoundParts {
  readonly side: boolean;
  readonly top: boolean;
  readonly bottom: boolean;
}

/** Along y around the origin; a cone has no radius at its top. */
export function round(topRadius: number, bottomRadius: number, height: number, parts: RoundParts): Solid {
  const builder = new SolidBuilder();
  const slope = (bottomRadius - topRadius) / height;
  const lean = Math.hypot(1, slope);
  const around = (segment: number) => {
    const phi = 2 * Math.PI * segment / segments;
    return [Math.sin(phi), Math.cos(phi)] as const;
  };
  const at = (segment: number, y: number, radius: number, normal?: readonly number[]) => {
    const [x, z] = around(segment);
    return [[x * radius, y, z * radius], normal ?? [x / lean, slope / lean, z / lean]] as const;
  };
  const [top, bottom] = [height / 2, -height / 2];
  for (let segment = 0; segment < segments; ++segment) {
    if (parts.side) {
      const quad = [at(segment, bottom, bottomRadius), at(segment + 1, bottom, bottomRadius), at(segment + 1, top, topRadius)];
      builder.addFace(...quad, ...topRadius > 0 ? [at(segment, top, topRadius)] : []);
    }
    const up = [0, 1, 0];
    const down = [0, -1, 0];
    if (parts.top && topRadius > 0) builder.addFace([[0, top, 0], up], at(segment, top, topRadius, up), at(segment + 1, top, topRadius, up));
    if (parts.bottom) builder.addFace([[0, bottom, 0], down], at(segment + 1, bottom, bottomRadius, down), at(segment, bottom, bottomRadius, down));
  }
  return builder.solid;
}
