#pragma once
// The readers behind import.h, one file per format. All take the unpacked bytes
// and the name that stands for them in messages, and keep import.h's promises.

#include "import/import.h"

#include <string_view>

namespace imgeo {

Imported readPly(ByteSpan bytes, const std::string& name, const ImportOptions& options);
Imported readObj(ByteSpan bytes, const std::string& name, const ImportOptions& options);
Imported readStl(ByteSpan bytes, const std::string& name, const ImportOptions& options);
Imported readGltf(ByteSpan bytes, const std::string& name, const ImportOptions& options);
Imported readX3d(ByteSpan bytes, const std::string& name, const ImportOptions& options);
Imported readVrml(ByteSpan bytes, const std::string& name, const ImportOptions& options);
/// Whatever else Assimp reads, in a process of its own.
Imported readByAssimp(ByteSpan bytes, const std::string& name, const ImportOptions& options);
bool isReadByAssimp(const std::string& name);

/// True where the bytes can only be this format.
bool looksLikePly(ByteSpan bytes);
bool looksLikeStl(ByteSpan bytes);
bool looksLikeGlb(ByteSpan bytes);
bool looksLikeGltf(ByteSpan bytes);
bool looksLikeX3d(ByteSpan bytes);
bool looksLikeVrml(ByteSpan bytes); ///< any version, and X3D in classic VRML encoding
/// True where the first line that says anything begins with a keyword of OBJ.
bool looksLikeObj(ByteSpan bytes);

/// "bunny" for "models/bunny.ply.gz".
std::string stemOf(const std::string& name);

/// "bunny.ply, byte 1042"
std::string byteLocation(const std::string& name, std::size_t byte);

/// Adds a mesh and the shape that shows it.
void addShape(Scene& scene, Mesh mesh, std::string shapeName);

} // namespace imgeo
