// Paths that the browser tests read from and write to.

import { fileURLToPath } from "node:url";
import { join } from "node:path";

export const repository = fileURLToPath(new URL("../..", import.meta.url));
/** The converter under test; the environment variable IMGEO overrides it. */
export const converter = process.env.IMGEO ?? join(repository, "build/imgeo");
/**
 * Generated meshes, converted sites, and the pictures of failed comparisons. Concurrent test processes need different
 * folders.
 */
export const outputDirectory = join(repository, process.env.IMGEO_TEST_OUTPUT ?? "build/browser-test");
/** Models outside the repository; tests that use them are skipped if they are missing. */
export const modelDirectory = join(process.env.IMGEO_SHARED ?? join(repository, "../shared"), "models");
