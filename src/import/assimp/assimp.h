#pragma once
// Collada, FBX, 3DS and every other format that Assimp reads and no other folder does: nodes, meshes, materials,
// textures, cameras and lights. Assimp runs in a process of its own (import/isolation).

#include "import/import.h"

namespace imgeo {

/// Whether Assimp reads files with this extension; loads the library.
bool isReadByAssimp(const std::string& name);
Imported readByAssimp(ByteSpan bytes, const std::string& name, const ImportOptions& options);
/// The same for bytes of the format that `extension` (".gltf") names, whatever the name says; Errors have the name.
Imported readByAssimp(ByteSpan bytes, const std::string& name, const ImportOptions& options,
                      const std::string& extension);

} // namespace imgeo
