// Where the strings of X3D's Text stand (ISO/IEC 19775-1, 15.2.2 and 15.4): lines or
// columns, aligned along both axes. How wide letters are, a font tells.

/** A font without its size, in CSS's words. */
export interface Font {
  readonly family: string;
  readonly isBold: boolean;
  readonly isItalic: boolean;
}

/** Of a run of text whose pen begins at 0 on its baseline; all in em. */
export interface RunMetrics {
  /** From its pen to that of what follows. */
  readonly advance: number;
  /** How far ink goes to the left, the right, up and down from there; none: all 0. */
  readonly ink: { readonly left: number; readonly right: number; readonly up: number; readonly down: number };
  /** Of the font: above the baseline, and below it. */
  readonly ascent: number;
  readonly descent: number;
}

export type MeasureRun = (font: Font, text: string) => RunMetrics;

/** Which part of a text lies at the origin. FIRST is the baseline of the first line. */
export const alignments = ["FIRST", "BEGIN", "MIDDLE", "END"] as const;
export type Alignment = (typeof alignments)[number];

export interface TextStyle {
  readonly font: Font;
  /** From one line, or column, to the next. */
  readonly spacing: number;
  /** False: letters stand one above the other, strings side by side. */
  readonly horizontal: boolean;
  readonly leftToRight: boolean;
  readonly topToBottom: boolean;
  /** Along a string, and from string to string. */
  readonly major: Alignment;
  readonly minor: Alignment;
}

/** Text that is drawn in one piece: where its pen begins, in em, and how much it is stretched from there. */
export interface PositionedRun {
  readonly text: string;
  readonly metrics: RunMetrics;
  readonly x: number;
  readonly y: number;
  readonly stretchX: number;
  readonly stretchY: number;
}

/** `lengths`, by string, and `maxExtent` are in em; 0: as long as the text is. */
export function layOut(
  strings: readonly string[],
  lengths: readonly number[],
  maxExtent: number,
  style: TextStyle,
  measure: MeasureRun,
): PositionedRun[] {
  return style.horizontal
    ? inLines(strings, lengths, maxExtent, style, measure)
    : inColumns(strings, lengths, maxExtent, style, measure);
}

/** By string: what its length is multiplied by. The longest, if it is longer than may be, shortens all by the same. */
function stretches(natural: readonly number[], lengths: readonly number[], maxExtent: number): number[] {
  const wanted = natural.map((length, i) => Math.max(lengths[i] ?? 0, 0) || length);
  const longest = Math.max(...wanted);
  const share = maxExtent > 0 && longest > maxExtent ? maxExtent / longest : 1;
  return natural.map((length, i) => (length > 0 ? ((wanted[i] ?? 0) * share) / length : 1));
}

/** What to add to a coordinate so that the aligned part of something from 0 to `extent`, which begins at its 0 or at its end, lies at the origin. */
function aligned(alignment: Alignment, extent: number, beginsAtZero: boolean): number {
  if (alignment === "MIDDLE") return -extent / 2;
  return (alignment === "END") === beginsAtZero ? -extent : 0;
}

function inLines(
  strings: readonly string[],
  lengths: readonly number[],
  maxExtent: number,
  style: TextStyle,
  measure: MeasureRun,
): PositionedRun[] {
  const { font, spacing, leftToRight, topToBottom, major, minor } = style;
  const lines = strings.map((string) => (leftToRight ? string : lettersOf(string).reverse().join("")));
  const metrics = lines.map((line) => measure(font, line));
  const [first] = metrics;
  if (first === undefined) return [];
  const stretched = stretches(
    metrics.map(({ advance }) => advance),
    lengths,
    maxExtent,
  );
  const { ascent, descent } = first;
  const height = (lines.length - 1) * spacing + ascent + descent;
  // From the lower edge of the lowest line.
  const toBaseline =
    minor === "FIRST" ? -(topToBottom ? height - ascent : descent) : aligned(minor, height, !topToBottom);
  return lines.map((text, i) => {
    const { advance } = metrics[i] ?? first;
    const stretchX = stretched[i] ?? 1;
    const below = topToBottom ? lines.length - 1 - i : i;
    return {
      text,
      metrics: metrics[i] ?? first,
      stretchX,
      stretchY: 1,
      x: aligned(major, advance * stretchX, leftToRight),
      y: toBaseline + descent + below * spacing,
    };
  });
}

/** A letter has a square of one em. */
function inColumns(
  strings: readonly string[],
  lengths: readonly number[],
  maxExtent: number,
  style: TextStyle,
  measure: MeasureRun,
): PositionedRun[] {
  const { font, spacing, leftToRight, topToBottom, major, minor } = style;
  const columns = strings.map(lettersOf);
  const stretched = stretches(
    columns.map(({ length }) => length),
    lengths,
    maxExtent,
  );
  const width = (columns.length - 1) * spacing + 1;
  const left = aligned(minor, width, leftToRight);
  return columns.flatMap((letters, i) => {
    const stretchY = stretched[i] ?? 1;
    const bottom = aligned(major, letters.length * stretchY, !topToBottom);
    const before = leftToRight ? i : columns.length - 1 - i;
    return letters.map((text, k) => {
      const metrics = measure(font, text);
      const { advance, ascent, descent } = metrics;
      const below = topToBottom ? letters.length - 1 - k : k;
      return {
        text,
        metrics,
        stretchX: 1,
        stretchY,
        x: left + before * spacing + (1 - advance) / 2,
        y: bottom + (below + descent / (ascent + descent)) * stretchY,
      };
    });
  });
}

/** What a reader takes for a letter may be several code points. */
function lettersOf(text: string): string[] {
  return Array.from(new Intl.Segmenter().segment(text), ({ segment }) => segment);
}
