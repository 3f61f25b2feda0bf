// Requests the page's fonts and reports when they load, because texts may have been drawn with fallback fonts before.

/** The subset of FontFaceSet that is needed. */
export interface FontSource {
  check(font: string, text: string): boolean;
  load(font: string, text: string): Promise<unknown>;
  addEventListener(
    type: "loadingdone",
    listener: (event: { readonly fontfaces: readonly { readonly family: string }[] }) => void,
    options: { signal: AbortSignal },
  ): void;
}

export class FontLoading {
  readonly #fonts: FontSource;
  readonly #loadCounts = new Map<string, number>();

  /** Calls `onLoad` when fonts of the page have loaded, however they were requested, until `signal` aborts. */
  constructor(fonts: FontSource, onLoad: () => void, signal: AbortSignal) {
    this.#fonts = fonts;
    fonts.addEventListener(
      "loadingdone",
      ({ fontfaces }) => {
        const families = new Set(fontfaces.map(({ family }) => normalizedName(family)));
        for (const family of families) this.#loadCounts.set(family, (this.#loadCounts.get(family) ?? 0) + 1);
        if (families.size > 0) onLoad();
      },
      { signal },
    );
  }

  /** Requests a font as far as the text needs it, and returns how many times fonts of its families have loaded. */
  editionOf(
    { family, isBold, isItalic }: { family: string; isBold: boolean; isItalic: boolean },
    text: string,
  ): number {
    const font = `${isItalic ? "italic " : ""}${isBold ? "bold " : ""}1px ${family}`;
    // Loading succeeds for families that the page lacks too. The browser reports failures.
    if (!this.#fonts.check(font, text)) this.#fonts.load(font, text).catch(() => undefined);
    return family.split(",").reduce((sum, each) => sum + (this.#loadCounts.get(normalizedName(each)) ?? 0), 0);
  }
}

/** Family names are compared case-insensitively and without quotes. */
function normalizedName(family: string): string {
  return family
    .trim()
    .replace(/^(["'])(.*)\1$/, "$2")
    .toLowerCase();
}
