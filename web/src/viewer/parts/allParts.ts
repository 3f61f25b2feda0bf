// All parts of the runtime, as parts of the module that imports this one.

import * as deformation from "./deformation.ts";
import * as documentGeometry from "./documentGeometry.ts";
import * as extensions from "./extensions.ts";
import * as files from "./files.ts";
import { LatePart } from "./latePart.ts";
import * as levels from "./levels.ts";
import * as operators from "./operators.ts";
import type { Parts } from "./parts.ts";
import * as streams from "./streams.ts";
import * as values from "./values.ts";

export const allParts: Parts = {
  documentGeometry: LatePart.of(documentGeometry),
  files: LatePart.of(files),
  streams: LatePart.of(streams),
  extensions: LatePart.of(extensions),
  levels: LatePart.of(levels),
  batches: LatePart.of({}), // apps draw each instance by an object of its own
  operators: LatePart.of(operators),
  environment: LatePart.of({}), // apps draw none of it
  walking: LatePart.of({}), // apps move their cameras
  deformation: LatePart.of(deformation),
  values: LatePart.of(values),
};
