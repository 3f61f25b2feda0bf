// Bundles the scripts of a test's own app.

import { join } from "node:path";
import { build } from "esbuild";
import { repository } from "./paths.ts";

/** Bundles each entry (a path in the repository) to the file that it is listed under, in `directory`. */
export async function bundleApp(entries: Readonly<Record<string, string>>, directory: string): Promise<void> {
  for (const [name, entry] of Object.entries(entries)) {
    await build({
      entryPoints: [join(repository, entry)],
      outfile: join(directory, name),
      bundle: true,
      format: "esm",
      target: "es2022",
      logLevel: "error",
    });
  }
}
