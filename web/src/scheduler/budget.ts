// What may be on the GPU at a time: as much as fits of what matters most, by the
// same number that orders requests. So what goes first when room is short is the
// finest of what is small, far or out of the view, and the last to go is the
// coarse shape of what is large before the camera.

/** Something that takes room, or would. */
export interface BudgetRequest {
  /** Claims of one key share their room: a file of several patches is stored once. */
  readonly key: unknown;
  readonly bytes: number;
  /** Larger comes first; 0 where nobody wants it now. */
  readonly priority: number;
  /** It has its room already, or is on its way there. */
  readonly isHeld: boolean;
}

/**
 * What has room keeps it against what matters less than this many times as much.
 * While the view stands still, priorities do too, and what is granted only grows;
 * while it moves, nothing goes to and fro over a small difference.
 */
const inertia = 2;

interface Ranked {
  readonly claim: BudgetRequest;
  /** Of use only with this one, the one before it in its chain. */
  readonly before: BudgetRequest | undefined;
  readonly rank: number;
}

/**
 * The claims that fit into `mostBytes` together. Each chain holds the claims of
 * one thing in the order of their use: none is granted without those before it.
 * What is wanted and does not fit is passed over for what does.
 */
export function grantedRequests(
  chains: Iterable<readonly BudgetRequest[]>,
  mostBytes: number,
): ReadonlySet<BudgetRequest> {
  const granted = new Set<BudgetRequest>();
  const keys = new Set<unknown>();
  let bytes = 0;
  for (const { claim, before } of ranked(chains)) {
    if (before !== undefined && !granted.has(before)) continue;
    const more = keys.has(claim.key) ? 0 : claim.bytes;
    if (bytes + more > mostBytes) continue;
    bytes += more;
    keys.add(claim.key);
    granted.add(claim);
  }
  return granted;
}

/** In order; a claim comes after those before it in its chain, whatever its own priority. */
function ranked(chains: Iterable<readonly BudgetRequest[]>): Ranked[] {
  const all: Ranked[] = [];
  for (const chain of chains) {
    let priority = Infinity;
    let isHeld = true;
    let before: BudgetRequest | undefined;
    for (const claim of chain) {
      priority = Math.min(priority, claim.priority);
      isHeld &&= claim.isHeld;
      all.push({ claim, before, rank: isHeld ? priority * inertia : priority });
      before = claim;
    }
  }
  return all.sort((a, b) => b.rank - a.rank); // a stable sort: chains keep their order
}
