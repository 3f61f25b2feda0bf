// A browser engine under test, and a page in it. Firefox and WebKit are Debian's own builds, which Playwright cannot
// drive: they speak the protocols of W3C (WebDriver BiDi, WebDriver).

/** CSS pixels, which are device pixels. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

export interface EnginePage {
  /** Resolves when the document has loaded. */
  goTo(url: string): Promise<void>;
  /** The value of an expression of JavaScript, or that of the promise that it is. */
  evaluate(expression: string): Promise<unknown>;
  /** The page as PNG. */
  picture(): Promise<Buffer>;
  /** Presses the mouse at the first point, moves it to the others, and releases it. */
  drag(points: readonly (readonly [x: number, y: number])[]): Promise<void>;
  close(): Promise<void>;
}

export interface Engine {
  readonly name: string;
  /** A page of this size, in a browser of its own. */
  readonly open: (size: Size) => Promise<EnginePage>;
}

/** The actions of a drag in WebDriver and in WebDriver BiDi. */
export function dragActions(points: readonly (readonly [x: number, y: number])[]): readonly unknown[] {
  const move = ([x, y]: readonly [number, number]): unknown => ({ type: "pointerMove", x, y, duration: 20 });
  const [first = [0, 0], ...others] = points;
  return [
    {
      type: "pointer",
      id: "mouse",
      parameters: { pointerType: "mouse" },
      actions: [move(first), { type: "pointerDown", button: 0 }, ...others.map(move), { type: "pointerUp", button: 0 }],
    },
  ];
}
