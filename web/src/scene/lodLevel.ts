// The level of a LOD for a distance (ISO/IEC 19775-1, 23.4.3): level i begins at range[i - 1].

/** The level changes only where the distance is beyond a bound by this fraction, so that it does not alternate there. */
const hysteresis = 0.05;

/** `current` is the visible level. An empty range gives level 0. */
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
