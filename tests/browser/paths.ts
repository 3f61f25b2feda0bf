// Where the browser tests find and leave things.

import { fileURLToPath } from "node:url";
import { join } from "node:path";

export const repository = fileURLToPath(new URL("../..", import.meta.url));
/** The converter under test; IMGEO names another build's. */
export const converter = process.env.IMGEO ?? join(repository, "build/imgeo");
/** Generated meshes, converted sites, and the pictures of failed comparisons. */
/** Each process that tests has its own: two may run at a time. */
export const outputDirectory = join(repository, process.env.IMGEO_TEST_OUTPUT ?? "build/browser-test");
/** Models that are no part of the repository; tests that use them skip where they are missing. */
export const modelDirectory = join(process.env.IMGEO_SHARED ?? join(repository, "../shared"), "models");
