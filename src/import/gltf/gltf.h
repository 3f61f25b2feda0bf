#pragma once
// glTF 2.0 and GLB: nodes, meshes (one mesh for all nodes that refer to it), materials, textures, cameras, punctual
// lights, the authors' extras; accessors compressed by Draco or meshopt, quantised, sparse, instanced. An attribute
// _NAME is the further attribute NAME. Damaged components are left out, with a warning, unless the options are strict.

#include "import/import.h"

namespace imgeo {

/// True for GLB headers but those of glTF 1.0 (gltf1.h), and for JSON objects that mention "asset" but those of 1.0.
bool isGltf(ByteSpan bytes);
Imported readGltf(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
