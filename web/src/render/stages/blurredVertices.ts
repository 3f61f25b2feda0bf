// The vertices of a stage in buffers after the operator blur: workers have decoded them from images, so that a vertex
// shader cannot read a vertex's neighbours. They are read back once and filtered here at each change of the radius.

import { DataTexture, FloatType, RGBAFormat } from "three";
import { blurred } from "../../decode/classic/blur.ts";
import { gridNormals } from "../../decode/vertexNormals.ts";
import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import { dequantizationOf } from "../../document/dequantization.ts";
import type { BufferStage, CoordImage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";

export class BlurredVertices {
  /** The coordinates of all vertices, then as many rows with their normals; texels of four floats. */
  readonly texture: DataTexture;
  /** The same coordinates, as stored ones: x, y and z of each vertex. */
  readonly points: Float32Array<ArrayBuffer>;
  readonly #source: Float32Array;
  readonly #image: CoordImage;
  readonly #normalsOf: (points: Float32Array<ArrayBuffer>) => Float32Array | undefined;
  #radius = 0;

  constructor(
    { coord }: BufferStage,
    image: CoordImage,
    geometry: GeometryDescription,
    patch: PatchDescription,
    buffers: BufferProvider,
  ) {
    const { stride, offset } = coord;
    const stored = buffers.read(coord.bytes, coord.type, 0);
    const count = Math.floor(stored.length / stride);
    this.#image = image;
    this.#source = new Float32Array(3 * count);
    this.#source.forEach((_, i, source) => {
      source[i] = stored[offset + stride * Math.floor(i / 3) + (i % 3)] ?? 0;
    });
    this.points = this.#source.slice();
    const { step } = dequantizationOf(geometry, patch);
    const { grid } = image;
    this.#normalsOf = (points) => grid && gridNormals({ array: points, stride: 3 }, grid, step, geometry.ccw ? 1 : -1);
    const rows = Math.ceil(count / image.columns);
    this.texture = new DataTexture(
      new Float32Array(4 * image.columns * 2 * rows),
      image.columns,
      2 * rows,
      RGBAFormat,
      FloatType,
    );
  }

  follow(radius: number): void {
    if (radius === this.#radius) return;
    this.#radius = radius;
    const { columns, grid } = this.#image;
    this.points.set(blurred({ points: this.#source, columns, isClosed: grid?.kind === "sculpt" }, radius));
    const texels = this.texture.image.data as Float32Array;
    const half = texels.length / 2;
    const normals = this.#normalsOf(this.points);
    for (let i = 0; i < this.points.length; ++i) {
      const at = 4 * Math.floor(i / 3) + (i % 3);
      texels[at] = this.points[i] ?? 0;
      if (normals) texels[half + at] = normals[i] ?? 0;
    }
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.texture.dispose();
  }
}
