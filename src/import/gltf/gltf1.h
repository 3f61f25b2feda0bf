#pragma once
// glTF 1.0 (Khronos Group, 2016), which Assimp reads; its GLB files (extension KHR_binary_glTF) become JSON for that,
// because Assimp 5.2 refuses them.

#include "import/import.h"

#include <string>
#include <string_view>

namespace imgeo {

/// Whether bytes begin with the magic number of GLB files, of any version.
bool isGlb(ByteSpan bytes);
/// Whether a text may be glTF's JSON, of any version: an object that mentions "asset".
bool resemblesGltf(std::string_view text);

/// The header of a GLB file says so; in JSON, the accessors are a dictionary and no array.
bool isGltf1(ByteSpan bytes);
Imported readGltf1(ByteSpan bytes, const std::string& name, const ImportOptions& options);

/// The JSON of a GLB file of glTF 1.0, with its buffer, images and shaders as data: URLs. Safe for untrusted bytes.
/// Throws Error{truncated, malformed}, and Error{limit} where images or shaders repeat the buffer too often.
std::string jsonOfGlb1(ByteSpan bytes, const std::string& name);

} // namespace imgeo
