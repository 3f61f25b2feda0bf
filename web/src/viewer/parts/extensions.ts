// The part "extensions": the GLSL of PhysicalMaterials with extensions.

import { lateExtensionShaders } from "../../render/materials/extendedMaterials.ts";
import { extensionShaders } from "../../render/materials/extendedShaders.ts";

export function add(): void {
  lateExtensionShaders.add(extensionShaders);
}
