// The parts of the runtime that come when a scene needs them.

import type { PartName } from "../../document/parts.ts";
import type * as deformation from "./deformation.ts";
import type * as documentGeometry from "./documentGeometry.ts";
import type { PartModule } from "./latePart.ts";
import { LatePart } from "./latePart.ts";
import type * as operators from "./operators.ts";

/** What the modules export. */
interface PartModules {
  readonly documentGeometry: typeof documentGeometry;
  readonly files: PartModule;
  readonly streams: PartModule;
  readonly extensions: PartModule;
  readonly levels: PartModule;
  readonly batches: PartModule;
  readonly operators: typeof operators;
  readonly environment: PartModule;
  readonly walking: PartModule;
  readonly deformation: typeof deformation;
  readonly values: PartModule;
}

export type Parts = { readonly [Name in PartName]: LatePart<PartModules[Name]> };

export type PartImports = { readonly [Name in PartName]: () => Promise<PartModules[Name]> };

export function partsFrom(imports: PartImports): Parts {
  return {
    documentGeometry: new LatePart(imports.documentGeometry),
    files: new LatePart(imports.files),
    streams: new LatePart(imports.streams),
    extensions: new LatePart(imports.extensions),
    levels: new LatePart(imports.levels),
    batches: new LatePart(imports.batches),
    operators: new LatePart(imports.operators),
    environment: new LatePart(imports.environment),
    walking: new LatePart(imports.walking),
    deformation: new LatePart(imports.deformation),
    values: new LatePart(imports.values),
  };
}
