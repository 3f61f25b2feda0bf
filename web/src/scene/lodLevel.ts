// The level of a LOD for a distance (ISO/IEC 19775-1, 23.4.3): level i begins at range[i - 1].

/** Relative hysteresis: the level changes only so far beyond a bound, so that it does not flicker there. */
const hysteresis = 0.05;

/** `current` is the level shown now. An empty range gives level 0. */
export function lodLevelAt(
  distance: number,
  range: readonly number[],
  count: number,
  current: number | undefined,
): number {
  const plain = (at: number) => Math.min(range.filter((bound) => bound <= at).length, count - 1);
  if (current === undefined) return plain(distance);
  const [nearest, farthest] = [plain(distance * (1 - hysteresis)), plain(distance * (1 + hysteresis))];
  return Math.min(Math.max(current, nearest), farthest);
}
