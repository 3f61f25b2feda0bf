// The layout of X3D's Text (ISO/IEC 19775-1, 15.2.2 and 15.4): positions of lines or columns of glyphs, aligned along
// both axes. The caller measures the runs.

/** A font without its size, in CSS terms. */
export interface Font {
  readonly family: string;
  readonly isBold: boolean;
  readonly isItalic: boolean;
}

/** Metrics of a run of text whose pen begins at 0 on its baseline; all in em. */
export interface RunMetrics {
  /** The distance from its pen position to the next run's. */
  readonly advance: number;
  /** The extents of the ink to the left, right, up and down of the pen; all 0 without ink. */
  readonly ink: { readonly left: number; readonly right: number; readonly up: number; readonly down: number };
  /** The font's extents above and below the baseline. */
  readonly ascent: number;
  readonly descent: number;
}

export type MeasureRun = (font: Font, text: string) => RunMetrics;

/** Which edge or line of a text lies at the origin. FIRST is the baseline of the first line. */
export const alignments = ["FIRST", "BEGIN", "MIDDLE", "END"] as const;
export type Alignment = (typeof alignments)[number];

export interface TextStyle {
  readonly font: Font;
  /** The distance between lines or columns. */
  readonly spacing: number;
  /** False: each string is a column of glyphs, and columns stand side by side. */
  readonly horizontal: boolean;
  readonly leftToRight: boolean;
  readonly topToBottom: boolean;
  /** The alignment along a string, and across strings. */
  readonly major: Alignment;
  readonly minor: Alignment;
}

/** A run of text that is drawn in one piece: the pen position, in em, and the scale from there. */
export interface PositionedRun {
  readonly text: string;
  readonly metrics: RunMetrics;
  readonly x: number;
  readonly y: number;
  readonly stretchX: number;
  readonly stretchY: number;
}

/**
 * Positions all runs. `lengths` has an entry for each string. All lengths are in em; a length of 0 keeps the natural
 * length, a `maxExtent` of 0 sets no limit.
 */
export function layOut(
  strings: readonly string[],
  lengths: readonly number[],
  maxExtent: number,
  style: TextStyle,
  measure: MeasureRun,
): PositionedRun[] {
  const stretches: Stretches = (natural) => stretchesOf(natural, lengths, maxExtent);
  return style.horizontal
    ? layOutLines(strings, style, measure, stretches)
    : layOutColumns(strings, style, measure, stretches);
}

/** Gives the scale of each string along its direction, from the natural lengths. */
type Stretches = (natural: readonly number[]) => number[];

/**
 * The scale of each string along its direction. Where the longest exceeds `maxExtent`, all strings shrink by the same
 * factor.
 */
function stretchesOf(natural: readonly number[], lengths: readonly number[], maxExtent: number): number[] {
  const requested = natural.map((length, i) => Math.max(lengths[i] ?? 0, 0) || length);
  const longest = Math.max(...requested);
  const factor = maxExtent > 0 && longest > maxExtent ? maxExtent / longest : 1;
  return natural.map((length, i) => (length > 0 ? ((requested[i] ?? 0) * factor) / length : 1));
}

/**
 * The offset that brings the aligned end or the middle of an interval 0 … `extent` to the origin; the text begins at 0
 * or at `extent`.
 */
function alignmentOffset(alignment: Alignment, extent: number, beginsAtZero: boolean): number {
  if (alignment === "MIDDLE") return -extent / 2;
  return (alignment === "END") === beginsAtZero ? -extent : 0;
}

function layOutLines(
  strings: readonly string[],
  { font, spacing, leftToRight, topToBottom, major, minor }: TextStyle,
  measure: MeasureRun,
  stretches: Stretches,
): PositionedRun[] {
  const lines = strings.map((string) => (leftToRight ? string : graphemesOf(string).reverse().join("")));
  const metrics = lines.map((line) => measure(font, line));
  const [first] = metrics;
  if (first === undefined) return [];
  const scales = stretches(metrics.map(({ advance }) => advance));
  const { ascent, descent } = first;
  const height = (lines.length - 1) * spacing + ascent + descent;
  // The position of the lower edge of the lowest line.
  const bottom =
    minor === "FIRST" ? -(topToBottom ? height - ascent : descent) : alignmentOffset(minor, height, !topToBottom);
  return lines.map((text, i) => {
    const { advance } = metrics[i] ?? first;
    const stretchX = scales[i] ?? 1;
    const countBelow = topToBottom ? lines.length - 1 - i : i;
    return {
      text,
      metrics: metrics[i] ?? first,
      stretchX,
      stretchY: 1,
      x: alignmentOffset(major, advance * stretchX, leftToRight),
      y: bottom + descent + countBelow * spacing,
    };
  });
}

/** Each glyph occupies a square of one em. */
function layOutColumns(
  strings: readonly string[],
  { font, spacing, leftToRight, topToBottom, major, minor }: TextStyle,
  measure: MeasureRun,
  stretches: Stretches,
): PositionedRun[] {
  const columns = strings.map(graphemesOf);
  const scales = stretches(columns.map(({ length }) => length));
  const width = (columns.length - 1) * spacing + 1;
  const left = alignmentOffset(minor, width, leftToRight);
  return columns.flatMap((graphemes, i) => {
    const stretchY = scales[i] ?? 1;
    const bottom = alignmentOffset(major, graphemes.length * stretchY, !topToBottom);
    const countBefore = leftToRight ? i : columns.length - 1 - i;
    return graphemes.map((text, k) => {
      const metrics = measure(font, text);
      const { advance, ascent, descent } = metrics;
      const countBelow = topToBottom ? graphemes.length - 1 - k : k;
      return {
        text,
        metrics,
        stretchX: 1,
        stretchY,
        x: left + countBefore * spacing + (1 - advance) / 2,
        y: bottom + (countBelow + descent / (ascent + descent)) * stretchY,
      };
    });
  });
}

/** Grapheme clusters: several code points may form one glyph. */
function graphemesOf(text: string): string[] {
  return Array.from(new Intl.Segmenter().segment(text), ({ segment }) => segment);
}
