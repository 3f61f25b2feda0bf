// The modules of a site as the bundler makes them, for all tests that look into them.

import { bundleSite } from "../bundle.ts";

let bundled: ReturnType<typeof bundleSite> | undefined;

/** Bundles once a run: that takes five seconds. */
export function bundledSite(): ReturnType<typeof bundleSite> {
  return (bundled ??= bundleSite());
}
