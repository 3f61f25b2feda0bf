// Sorts the members of all transparent batches from back to front. Consecutive members of the same
// batch are drawn with one call.

import type { Frustum, Matrix4 } from "three";
import { Sphere } from "three";
import type { Batch, Member, Run } from "./batch.ts";
import type { MemberTable } from "./memberTable.ts";

const sphere = new Sphere();

/**
 * The runs of the visible members, by batch. `table` has the bounds of the members; `viewFromRoot` transforms the
 * coordinates of the batches' root to those of the camera.
 */
export function visibleRuns(
  members: Iterable<Member>,
  table: MemberTable,
  frustum: Frustum,
  viewFromRoot: Matrix4,
): Map<Batch, Run[]> {
  const [, , xz, , , , yz, , , , zz] = viewFromRoot.elements;
  const visible: { readonly member: Member; readonly batch: Batch; readonly viewZ: number }[] = [];
  for (const member of members) {
    const { batch, isVisible, instanceIndex } = member;
    if (batch === undefined || !isVisible) continue;
    if (!frustum.intersectsSphere(table.sphereOf(instanceIndex, sphere))) continue;
    const { x, y, z } = sphere.center;
    visible.push({ member, batch, viewZ: xz * x + yz * y + zz * z }); // the camera looks along its -z
  }
  visible.sort((a, b) => a.viewZ - b.viewZ);
  const runs = new Map<Batch, Run[]>();
  let last: { readonly batch: Batch; readonly members: Member[] } | undefined;
  let order = 0;
  for (const { member, batch } of visible) {
    if (last?.batch !== batch) {
      last = { batch, members: [] };
      order += 1;
      const batchRuns = runs.get(batch) ?? [];
      batchRuns.push({ members: last.members, order });
      runs.set(batch, batchRuns);
    }
    last.members.push(member);
  }
  return runs;
}
