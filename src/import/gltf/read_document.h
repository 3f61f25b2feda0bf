#pragma once
// The steps of reading a glTF document, for readers of large files.

#include "import/gltf/nodes.h"
#include "import/import.h"

#include <string>
#include <string_view>

namespace imgeo::gltf {

/// The contents of a GLB file; `binary` is empty if there is none.
struct GlbChunks {
  std::string_view json;
  ByteSpan binary;
};

/// The chunks of a GLB file, or the text of a glTF file. Throws Error{truncated, unsupported} naming `name`.
GlbChunks chunksOf(ByteSpan bytes, const std::string& name);

/// Throws Error{unsupported} for another version than 2 and for a required extension that imgeo does not read.
void checkSupported(const Value& root);

/// Reads the scene of a document. `format`: "GLB" or "glTF".
Imported readDocument(Document& document, const char* format, const ImportOptions& options);
/// The same with the meshes that `primitives` reads, one by one in the order of the scene's.
Imported readDocument(Document& document, const char* format, const ImportOptions& options,
                      PrimitiveReader& primitives);

} // namespace imgeo::gltf
