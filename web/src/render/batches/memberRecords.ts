// Writes the record and the bounds of each member of the batches. What a moved member costs is spent here.

import type { Matrix4 } from "three";
import { instanceFields } from "../shaders/instanceRecord.ts";
import type { BatchedDraw, Member } from "./batch.ts";
import { InstanceTable } from "./instanceTable.ts";
import { memberFields, MemberTable, numbersPerMember } from "./memberTable.ts";

export class MemberRecords {
  /** On the GPU. */
  readonly table = new InstanceTable();
  readonly members = new MemberTable();
  readonly #sceneFromRoot: Matrix4;

  /** Records and bounds are relative to the batches' root, which `sceneFromRoot` translates. */
  constructor(sceneFromRoot: Matrix4) {
    this.#sceneFromRoot = sceneFromRoot;
  }

  /** Returns the index of a new record, with all that does not depend on the instance's group. */
  add(draw: BatchedDraw, materialNumbers: readonly number[]): number {
    const instanceIndex = this.table.allocate();
    this.members.add(instanceIndex, draw);
    this.table.write(instanceIndex, instanceFields.step, draw.step);
    this.table.write(instanceIndex, instanceFields.texCoordFrames, draw.texCoordFrames);
    if (draw.valueFrame) {
      this.table.write(instanceIndex, instanceFields.valueMin, draw.valueFrame.min);
      this.table.write(instanceIndex, instanceFields.valueStep, draw.valueFrame.step);
    }
    this.table.write(instanceIndex, instanceFields.material, materialNumbers);
    return instanceIndex;
  }

  /**
   * Writes the matrix, visibility and effect scope of a member's group into its record, and the bounds. The two
   * products of matrices are written out: the root only translates, and stored coordinates are scaled and translated.
   */
  write(member: Member): void {
    const { group, instanceIndex } = member;
    const { elements: m } = group.matrixWorld;
    const { elements: root } = this.#sceneFromRoot;
    const row = this.members.numbers;
    const at = instanceIndex * numbersPerMember;
    const originX = number(row, at);
    const originY = number(row, at + 1);
    const originZ = number(row, at + 2);
    const stepX = number(row, at + memberFields.step);
    const stepY = number(row, at + memberFields.step + 1);
    const stepZ = number(row, at + memberFields.step + 2);
    member.isVisible = group.visible;
    member.isMirrored = isMirroring(m) !== stepX * stepY * stepZ < 0;
    // three.js detects mirroring by the object's matrix, so the object is mirrored, and the record
    // is multiplied by the same mirror.
    const mirror = member.isMirrored ? -1 : 1;
    const { 0: m0, 1: m1, 2: m2, 4: m4, 5: m5, 6: m6, 8: m8, 9: m9, 10: m10 } = m;
    const x = m0 * originX + m4 * originY + m8 * originZ + (m[12] - root[12]);
    const y = m1 * originX + m5 * originY + m9 * originZ + (m[13] - root[13]);
    const z = m2 * originX + m6 * originY + m10 * originZ + (m[14] - root[14]);
    const begin = this.table.change(instanceIndex);
    const record = this.table.numbers;
    record[begin] = mirror * m0 * stepX;
    record[begin + 1] = mirror * m4 * stepY;
    record[begin + 2] = mirror * m8 * stepZ;
    record[begin + 3] = mirror * x;
    record[begin + 4] = m1 * stepX;
    record[begin + 5] = m5 * stepY;
    record[begin + 6] = m9 * stepZ;
    record[begin + 7] = y;
    record[begin + 8] = m2 * stepX;
    record[begin + 9] = m6 * stepY;
    record[begin + 10] = m10 * stepZ;
    record[begin + 11] = z;
    record[begin + instanceFields.visibleInScope] = member.isVisible ? 1 + (group.effectScope?.value ?? 0) : 0;
    const bounds = at + memberFields.storedBounds;
    const centerX = number(row, bounds) * stepX;
    const centerY = number(row, bounds + 1) * stepY;
    const centerZ = number(row, bounds + 2) * stepZ;
    const sphere = at + memberFields.sphere;
    row[sphere] = m0 * centerX + m4 * centerY + m8 * centerZ + x;
    row[sphere + 1] = m1 * centerX + m5 * centerY + m9 * centerZ + y;
    row[sphere + 2] = m2 * centerX + m6 * centerY + m10 * centerZ + z;
    const scaleX = (m0 * m0 + m1 * m1 + m2 * m2) * stepX * stepX;
    const scaleY = (m4 * m4 + m5 * m5 + m6 * m6) * stepY * stepY;
    const scaleZ = (m8 * m8 + m9 * m9 + m10 * m10) * stepZ * stepZ;
    row[sphere + 3] = number(row, bounds + 3) * Math.sqrt(Math.max(scaleX, scaleY, scaleZ));
  }
}

function number(row: Float64Array, at: number): number {
  return row[at] ?? NaN;
}

/** Whether an affine matrix has a negative determinant. */
function isMirroring(m: Matrix4["elements"]): boolean {
  return (
    m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]) < 0
  );
}
