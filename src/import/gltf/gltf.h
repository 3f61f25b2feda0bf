#pragma once
// glTF 2.0 and GLB: nodes, meshes (one mesh for all nodes that refer to it), materials, textures, cameras, punctual
// lights, the authors' extras; accessors compressed by Draco or meshopt, quantised, sparse, instanced. An attribute
// _NAME is the further attribute NAME. Damaged components are left out, with a warning, unless the options are strict.

#include "import/import.h"

namespace imgeo {

/// True for glTF 1.0, which Assimp reads (formats.cpp): the header of a GLB file says so; in JSON, the accessors are a
/// dictionary and no array.
bool isGltf1(ByteSpan bytes);
/// True for other GLB headers, and for other JSON objects that mention "asset".
bool isGltf(ByteSpan bytes);
Imported readGltf(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
