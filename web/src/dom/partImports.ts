// The modules of the runtime's parts, each beside this one. The page's module imports them, so that no other names them.

import type { PartImports } from "../viewer/parts/parts.ts";

export const partImports: PartImports = {
  documentGeometry: () => import("../viewer/parts/documentGeometry.ts"),
  files: () => import("../viewer/parts/files.ts"),
  streams: () => import("../viewer/parts/streams.ts"),
};
