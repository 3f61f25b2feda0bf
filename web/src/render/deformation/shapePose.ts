// The pose of one shape: the matrices of its joints and the weights of its displacers, in one texture of floats.

import { DataTexture, FloatType, RGBAFormat } from "three";
import type { Matrix4 } from "three";
import { texelsPerJoint } from "./deformationChunk.ts";

const maxWidth = 1024;

export class ShapePose {
  /** The rows of each joint's matrix, then four weights in a texel. */
  readonly texture: DataTexture;
  readonly jointCount: number;
  readonly displacerCount: number;
  readonly #texels: Float32Array;

  constructor(jointCount: number, displacerCount: number) {
    this.jointCount = jointCount;
    this.displacerCount = displacerCount;
    const count = Math.max(1, texelsPerJoint * jointCount + Math.ceil(displacerCount / 4));
    const width = Math.min(count, maxWidth);
    const height = Math.ceil(count / width);
    this.#texels = new Float32Array(4 * width * height);
    this.texture = new DataTexture(this.#texels, width, height, RGBAFormat, FloatType);
  }

  /** `matrices`: of each joint, for points in the shape's coordinates. `weights`: of each displacer. */
  set(matrices: readonly Matrix4[], weights: readonly number[]): void {
    matrices.forEach(({ elements }, joint) => {
      for (let row = 0; row < 3; ++row)
        for (let column = 0; column < 4; ++column)
          this.#texels[4 * (texelsPerJoint * joint + row) + column] = elements[4 * column + row] ?? 0;
    });
    this.#texels.set(weights, 4 * texelsPerJoint * this.jointCount);
    this.texture.needsUpdate = true;
  }

  /** Row `row` of a joint's matrix. */
  rowOf(joint: number, row: number): readonly [number, number, number, number] {
    const at = 4 * (texelsPerJoint * joint + row);
    const [x = 0, y = 0, z = 0, w = 0] = this.#texels.subarray(at, at + 4);
    return [x, y, z, w];
  }

  weightOf(displacer: number): number {
    return this.#texels[4 * texelsPerJoint * this.jointCount + displacer] ?? 0;
  }

  dispose(): void {
    this.texture.dispose();
  }
}
