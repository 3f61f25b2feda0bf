// Pages whose <x3d> has attributes and further elements, for tests of a view.

import assert from "node:assert/strict";
import { withPage, type PageOptions, type View } from "./harness.ts";
import { siteOfGenerated, variantOf } from "./sites.ts";
import { recordViewEvents } from "./viewEvents.ts";

/** The page with attributes on its <x3d>, elements in it, and more around it. */
export function siteWith(name: string, { attributes = "", inside = "", before = "", after = "" }): string {
  return variantOf(siteOfGenerated("trefoil", "--profile", "classic"), name, (page) =>
    page
      .replace(/<X3D/i, `<X3D ${attributes}`)
      .replace(/<\/X3D>/i, (end) => `${inside}${end}${after}`)
      .replace(/<body[^>]*>/i, (start) => `${start}${before}`),
  );
}

/** Opens a site, with its view events recorded, and calls `use` when everything is displayed. */
export async function withScene(site: string, options: PageOptions, use: (view: View) => Promise<void>): Promise<void> {
  await withPage(site, { before: recordViewEvents, ...options }, async (view) => {
    await view.promise("complete");
    await use(view);
  });
}

export function assertNear(actual: number, expected: number, tolerance = 1e-6): void {
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);
}
