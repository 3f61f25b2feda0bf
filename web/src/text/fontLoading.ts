// Fonts that the page brings, and that come after a text has been drawn in others.

/** What of a page's FontFaceSet is needed. */
export interface FontSource {
  check(font: string, letters: string): boolean;
  load(font: string, letters: string): Promise<unknown>;
  addEventListener(
    type: "loadingdone",
    listener: (event: { readonly fontfaces: readonly { readonly family: string }[] }) => void,
    options: { signal: AbortSignal },
  ): void;
}

export class FontLoading {
  readonly #fonts: FontSource;
  readonly #comings = new Map<string, number>();

  /** `onCome` is called until `signal` aborts, when fonts that were asked for, by whomever, have come. */
  constructor(fonts: FontSource, onCome: () => void, signal: AbortSignal) {
    this.#fonts = fonts;
    fonts.addEventListener(
      "loadingdone",
      ({ fontfaces }) => {
        const families = new Set(fontfaces.map(({ family }) => nameOf(family)));
        for (const family of families) this.#comings.set(family, (this.#comings.get(family) ?? 0) + 1);
        if (families.size > 0) onCome();
      },
      { signal },
    );
  }

  /** Asks for a font, in CSS's words but for its size, as far as letters need it; how often any of its families has come. */
  editionOf(
    { family, isBold, isItalic }: { family: string; isBold: boolean; isItalic: boolean },
    letters: string,
  ): number {
    const font = `${isItalic ? "italic " : ""}${isBold ? "bold " : ""}1px ${family}`;
    // Who asks for nothing that the page has is answered as well. What fails the browser reports.
    if (!this.#fonts.check(font, letters)) this.#fonts.load(font, letters).catch(() => undefined);
    return family.split(",").reduce((sum, each) => sum + (this.#comings.get(nameOf(each)) ?? 0), 0);
  }
}

/** Families are told apart without their quotes and regardless of case. */
function nameOf(family: string): string {
  return family
    .trim()
    .replace(/^(["'])(.*)\1$/, "$2")
    .toLowerCase();
}
