// The page of a three.js app that a test has bundled.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { TestServer } from "./server.ts";

/** Serves files of a folder, of which app.js is the app, and at `path` the page that runs it without margins. */
export function serveApp(server: TestServer, path: string, folder: string, files: Iterable<string>): void {
  server.put(
    path,
    `<!doctype html><meta charset="utf-8"><link rel="stylesheet" href="/app.css"><script type="module" src="/app.js"></script><body>`,
  );
  server.put("/app.css", "body { margin: 0 } canvas { display: block }");
  for (const name of files) server.put(`/${name}`, readFileSync(join(folder, name)));
}
