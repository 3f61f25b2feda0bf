import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { FontSource } from "./fontLoading.ts";
import { FontLoading } from "./fontLoading.ts";

const plain = { family: '"My Font", serif', isBold: false, isItalic: false };

/** A page's fonts: `finishLoading` reports that fonts of some families have been loaded. */
function fakeFonts(isLoaded: (font: string) => boolean): {
  fonts: FontSource;
  requests: string[];
  finishLoading: (...families: string[]) => void;
} {
  const requests: string[] = [];
  const listeners: Parameters<FontSource["addEventListener"]>[1][] = [];
  return {
    requests,
    finishLoading: (...families) => {
      for (const listener of listeners) listener({ fontfaces: families.map((family) => ({ family })) });
    },
    fonts: {
      check: (font) => isLoaded(font),
      load: (font, characters) => {
        requests.push(`${font}: ${characters}`);
        return Promise.reject(new Error("not found"));
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
  test("are requested for the displayed text, unless they are loaded; a failure raises no error", () => {
    const { fonts, requests } = fakeFonts((font) => font.endsWith("px serif"));
    const loading = new FontLoading(fonts, () => undefined, new AbortController().signal);
    loading.editionOf(plain, "ab");
    loading.editionOf({ family: "serif", isBold: true, isItalic: false }, "ab");
    loading.editionOf({ ...plain, isBold: true, isItalic: true }, "c");
    assert.deepEqual(requests, ['1px "My Font", serif: ab', 'italic bold 1px "My Font", serif: c']);
  });

  test("change the edition of texts that name them, in any case and quotes, and are reported until the signal aborts", () => {
    const { fonts, finishLoading } = fakeFonts(() => true);
    const listening = new AbortController();
    let changeCount = 0;
    const loading = new FontLoading(
      fonts,
      () => {
        changeCount += 1;
      },
      listening.signal,
    );
    const editions = () => [plain, { ...plain, family: "serif" }].map((font) => loading.editionOf(font, "a"));
    assert.deepEqual(editions(), [0, 0]);
    finishLoading("'my font'", "my font"); // two faces of one family
    assert.deepEqual([editions(), changeCount], [[1, 0], 1]);
    finishLoading("Other");
    finishLoading();
    assert.deepEqual([editions(), changeCount], [[1, 0], 2]);
    finishLoading("My Font");
    listening.abort();
    finishLoading("My Font");
    assert.deepEqual([editions(), changeCount], [[2, 0], 3]);
  });
});
