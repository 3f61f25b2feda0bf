// What is drawn of an open group: the segments of its children that are closed, in few runs of triangles.

/** Consecutive triangles of a group's index buffer. */
export interface TriangleRange {
  readonly first: number;
  readonly count: number;
}

/**
 * The triangles of an open group that are drawn. `children`: of the index; none on level 0, where all is drawn.
 * `segmentStarts`: the first triangle of each child's segment, and at the end the number of triangles. Adjacent segments
 * are joined; nothing is drawn of a group all of whose children are open.
 */
export function drawRanges(
  children: ArrayLike<number>,
  segmentStarts: ArrayLike<number>,
  open: ReadonlySet<number>,
): TriangleRange[] {
  if (segmentStarts.length !== children.length + 1 && children.length > 0)
    throw new Error(`${segmentStarts.length} starts of the segments of ${children.length} children`);
  const count = segmentStarts[segmentStarts.length - 1] ?? 0;
  if (children.length === 0) return [{ first: 0, count }];
  const ranges: TriangleRange[] = [];
  for (let i = 0, begin = -1; i <= children.length; ++i) {
    const isDrawn = i < children.length && !open.has(children[i]!);
    if (isDrawn && begin < 0) begin = segmentStarts[i]!;
    if (isDrawn || begin < 0) continue;
    ranges.push({ first: begin, count: segmentStarts[i]! - begin });
    begin = -1;
  }
  return ranges;
}
