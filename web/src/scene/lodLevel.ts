// Which level of a LOD is seen (ISO/IEC 19775-1, 23.4.3): level i from range[i - 1] on.

/** A level is left only so much beyond its bounds, so that nobody on a bound sees it flicker. */
const slack = 0.05;

/** `current`: the level that is seen now. Without a range the first of `count` levels is. */
export function lodLevelAt(
  distance: number,
  range: readonly number[],
  count: number,
  current: number | undefined,
): number {
  const plain = (at: number) => Math.min(range.filter((bound) => bound <= at).length, count - 1);
  if (current === undefined) return plain(distance);
  const [nearest, farthest] = [plain(distance * (1 - slack)), plain(distance * (1 + slack))];
  return Math.min(Math.max(current, nearest), farthest);
}
