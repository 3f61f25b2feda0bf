// The draw order of everything that blends: back to front, across all batches. Consecutive members
// of one batch are one draw call.

import type { Frustum, Matrix4 } from "three";
import type { Batch, Member, Run } from "./batch.ts";

/**
 * Runs of the visible members, by batch. `viewFromRoot`: from the coordinates of the members' spheres to the camera's.
 */
export function runsOf(members: Iterable<Member>, frustum: Frustum, viewFromRoot: Matrix4): Map<Batch, Run[]> {
  const [, , xz, , , , yz, , , , zz] = viewFromRoot.elements;
  const seen: { readonly member: Member; readonly batch: Batch; readonly height: number }[] = [];
  for (const member of members) {
    const { batch, isVisible, sphere } = member;
    if (batch === undefined || !isVisible || !frustum.intersectsSphere(sphere)) continue;
    const { x, y, z } = sphere.center;
    seen.push({ member, batch, height: xz * x + yz * y + zz * z }); // the camera looks along its -z
  }
  seen.sort((a, b) => a.height - b.height);
  const runs = new Map<Batch, Run[]>();
  let last: { readonly batch: Batch; readonly members: Member[] } | undefined;
  let order = 0;
  for (const { member, batch } of seen) {
    if (last?.batch !== batch) {
      last = { batch, members: [] };
      order += 1;
      const own = runs.get(batch) ?? [];
      own.push({ members: last.members, order });
      runs.set(batch, own);
    }
    last.members.push(member);
  }
  return runs;
}
