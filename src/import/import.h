#pragma once
// import: the bytes of a file -> Scene. One file per format; this header is all
// that other folders see.

#include "base/bytes.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace imgeo {

struct Imported {
  Scene scene;        ///< one shape per object of the source; normals only where the file has them
  std::string format; ///< "PLY", "OBJ", "STL": for reports
  std::vector<std::string> warnings; ///< one sentence per kind of thing not carried over
};

/// Reads a file of any known format; the format is told from the content first,
/// the name's ending second. A gzipped file (magic 1f 8b) is unpacked first.
/// Safe for untrusted bytes: counts are checked against the bytes that are left
/// before anything is allocated; NaN and infinite coordinates are refused.
/// Throws Error (io, truncated, malformed, unsupported, limit) with file and
/// line (text) or byte (binary).
Imported importFile(const std::filesystem::path& path);

/// The same for bytes at hand; `name` stands for the file in messages and its
/// ending helps to tell the format.
Imported importBytes(ByteSpan bytes, const std::string& name);

} // namespace imgeo
