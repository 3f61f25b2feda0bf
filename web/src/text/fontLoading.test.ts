import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { FontSource } from "./fontLoading.ts";
import { FontLoading } from "./fontLoading.ts";

const plain = { family: '"My Font", serif', isBold: false, isItalic: false };

/** A page whose fonts come when `come` says so. */
function fakeFonts(isHere: (font: string) => boolean): {
  fonts: FontSource;
  asked: string[];
  come: (...families: string[]) => void;
} {
  const asked: string[] = [];
  const listeners: Parameters<FontSource["addEventListener"]>[1][] = [];
  return {
    asked,
    come: (...families) => {
      for (const listener of listeners) listener({ fontfaces: families.map((family) => ({ family })) });
    },
    fonts: {
      check: (font) => isHere(font),
      load: (font, letters) => {
        asked.push(`${font}: ${letters}`);
        return Promise.reject(new Error("nobody serves it"));
      },
      addEventListener: (_, listener, { signal }) => {
        listeners.push(listener);
        signal.addEventListener("abort", () => {
          listeners.splice(listeners.indexOf(listener), 1);
        });
      },
    },
  };
}

describe("fonts of the page", () => {
  test("are requested for the text shown, unless they are loaded; a failure is no error", () => {
    const { fonts, asked } = fakeFonts((font) => font.endsWith("px serif"));
    const late = new FontLoading(fonts, () => undefined, new AbortController().signal);
    late.editionOf(plain, "ab");
    late.editionOf({ family: "serif", isBold: true, isItalic: false }, "ab");
    late.editionOf({ ...plain, isBold: true, isItalic: true }, "c");
    assert.deepEqual(asked, ['1px "My Font", serif: ab', 'italic bold 1px "My Font", serif: c']);
  });

  test("change the edition of texts that name them, in any case and quotes, and are reported until the signal aborts", () => {
    const { fonts, come } = fakeFonts(() => true);
    const listening = new AbortController();
    let heard = 0;
    const late = new FontLoading(
      fonts,
      () => {
        heard += 1;
      },
      listening.signal,
    );
    const editions = () => [plain, { ...plain, family: "serif" }].map((font) => late.editionOf(font, "a"));
    assert.deepEqual(editions(), [0, 0]);
    come("'my font'", "my font"); // two faces of one family
    assert.deepEqual([editions(), heard], [[1, 0], 1]);
    come("Other");
    come();
    assert.deepEqual([editions(), heard], [[1, 0], 2]);
    come("My Font");
    listening.abort();
    come("My Font");
    assert.deepEqual([editions(), heard], [[2, 0], 3]);
  });
});
