// The level of a LOD for a distance (ISO/IEC 19775-1, 23.4.3): level i begins at range[i - 1].

/**
 * A level is left only when the distance is beyond its bound by this fraction, so that levels do not alternate there.
 */
const hysteresis = 0.05;

/** `count` is the number of levels, `current` the visible one. An empty range gives level 0. */
export function lodLevelAt(
  distance: number,
  range: readonly number[],
  count: number,
  current: number | undefined,
): number {
  const levelWithoutHysteresis = (testedDistance: number) =>
    Math.min(range.filter((bound) => bound <= testedDistance).length, count - 1);
  if (current === undefined) return levelWithoutHysteresis(distance);
  const [nearest, farthest] = [
    levelWithoutHysteresis(distance * (1 - hysteresis)),
    levelWithoutHysteresis(distance * (1 + hysteresis)),
  ];
  return Math.min(Math.max(current, nearest), farthest);
}
