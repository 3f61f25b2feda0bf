// Which labels of a view are displayed where several would overlap.

/** A label around a point on the canvas; lengths in CSS pixels. */
export interface LabelBox {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
  /** The label with the first key stays: keys are compared number by number, lower ones first. */
  readonly order: readonly number[];
  /**
   * Whether the label gave way in the last frame: it comes back only where it has some space, so that it does not
   * flicker.
   */
  readonly isDisplaced: boolean;
}

/** The space around a label that comes back, CSS pixels. */
const returnMargin = 4;

/** The labels that give way to others. Takes time with the square of the number of labels that are displayed. */
export function displacedLabels<Label extends LabelBox>(labels: readonly Label[]): Set<Label> {
  const displayed: Label[] = [];
  const displaced = new Set<Label>();
  for (const label of labels.toSorted((a, b) => compare(a.order, b.order))) {
    const margin = label.isDisplaced ? returnMargin : 0;
    if (displayed.some((other) => overlap(label, other, margin))) displaced.add(label);
    else displayed.push(label);
  }
  return displaced;
}

function overlap(a: LabelBox, b: LabelBox, margin: number): boolean {
  return (
    Math.abs(a.x - b.x) < (a.width + b.width) / 2 + margin && Math.abs(a.y - b.y) < (a.height + b.height) / 2 + margin
  );
}

function compare(a: readonly number[], b: readonly number[]): number {
  const at = a.findIndex((value, i) => value !== b[i]);
  return at < 0 ? 0 : (a[at] ?? 0) - (b[at] ?? 0);
}
