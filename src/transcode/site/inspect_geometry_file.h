#pragma once
// What a single geometry file of a site holds.

#include <cstdint>
#include <filesystem>
#include <string>

namespace imgeo {

/// One geometry file of a site.
struct GeometryFileInfo {
  std::string kind; ///< "PNG image", "typed array"
  std::uint64_t bytes = 0;
  std::uint32_t width = 0, height = 0, channels = 0; ///< 0: not an image
  bool namedByContent = false;                       ///< the file's name is the hash of its content
};

/// Decodes a .png or .webp file; takes any other file for a typed array. Safe for untrusted bytes. Throws Error.
GeometryFileInfo inspectGeometryFile(const std::filesystem::path& file);

} // namespace imgeo
