// The deformation of a stage that is drawn: its texture and uniforms, and where a vertex is, for picking.

import type { IUniform, Vector3 } from "three";
import { DataTexture, FloatType, RGBAFormat } from "three";
import type { GeometryDescription, PatchDescription, Vec3 } from "../../document/description.ts";
import { dequantizationOf } from "../../document/dequantization.ts";
import type { Deformation } from "../../stage/deformation.ts";
import { texelsPerVertex } from "../../stage/deformation.ts";
import { deformationDefinesOf } from "./deformationChunk.ts";
import type { ShapePose } from "./shapePose.ts";

const width = 2048;

export class StageDeformation {
  readonly defines: Readonly<Record<string, string>>;
  readonly uniforms: Readonly<Record<string, IUniform>>;
  readonly #deformation: Deformation;
  readonly #pose: ShapePose;
  readonly #frame: { readonly origin: Vec3; readonly step: Vec3 };
  readonly #texture: DataTexture;

  constructor(deformation: Deformation, pose: ShapePose, geometry: GeometryDescription, patch: PatchDescription) {
    this.#deformation = deformation;
    this.#pose = pose;
    this.#frame = dequantizationOf(geometry, patch);
    this.#texture = textureOf(deformation.texels);
    this.defines = deformationDefinesOf(deformation.layout);
    this.uniforms = {
      deformationImage: { value: this.#texture },
      poseImage: { value: pose.texture },
      latticeOrigin: { value: this.#frame.origin },
      jointCount: { value: pose.jointCount },
    };
  }

  /** Moves the stored coordinates of a vertex as `deform` in deformationChunk.ts does. */
  move(stored: Vector3, vertex: number): Vector3 {
    const { origin, step } = this.#frame;
    const { layout, texels } = this.#deformation;
    const first = 4 * texelsPerVertex(layout) * vertex;
    let point: Vec3 = [origin[0] + step[0] * stored.x, origin[1] + step[1] * stored.y, origin[2] + step[2] * stored.z];
    for (let displacer = 0; displacer < layout.displacers; ++displacer) {
      const weight = this.#pose.weightOf(displacer);
      const at = first + 4 * (2 * layout.jointSets + displacer * (layout.displacesNormals ? 2 : 1));
      const along = (axis: 0 | 1 | 2) => point[axis] + weight * (texels[at + axis] ?? 0);
      point = [along(0), along(1), along(2)];
    }
    if (layout.jointSets > 0 && this.#pose.jointCount > 0) point = this.#followJoints(point, first);
    return stored.set(
      (point[0] - origin[0]) / step[0],
      (point[1] - origin[1]) / step[1],
      (point[2] - origin[2]) / step[2],
    );
  }

  dispose(): void {
    this.#texture.dispose();
  }

  #followJoints(point: Vec3, first: number): Vec3 {
    const { layout, texels } = this.#deformation;
    const moved: [number, number, number] = [0, 0, 0];
    let sum = 0;
    for (let i = 0; i < 4 * layout.jointSets; ++i) {
      const at = first + 8 * Math.floor(i / 4) + (i % 4);
      const weight = texels[at + 4] ?? 0;
      if (weight === 0) continue;
      sum += weight;
      for (const axis of [0, 1, 2] as const) {
        const [x, y, z, w] = this.#pose.rowOf(Math.round(texels[at] ?? 0), axis);
        moved[axis] += weight * (x * point[0] + y * point[1] + z * point[2] + w);
      }
    }
    return sum === 0 ? point : [moved[0] / sum, moved[1] / sum, moved[2] / sum];
  }
}

function textureOf(texels: Float32Array<ArrayBuffer>): DataTexture {
  const count = Math.max(1, texels.length / 4);
  const columns = Math.min(count, width);
  const rows = Math.ceil(count / columns);
  const padded = new Float32Array(4 * columns * rows);
  padded.set(texels);
  const texture = new DataTexture(padded, columns, rows, RGBAFormat, FloatType);
  texture.needsUpdate = true;
  return texture;
}
