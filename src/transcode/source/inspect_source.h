#pragma once
// What a mesh or scene file holds, before it is converted.

#include "base/vec.h"
#include "imgeo/elements.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace imgeo {

struct SourceInfo {
  std::string format;
  std::uint64_t bytes = 0;
  ElementCounts elements;
  std::size_t shapes = 0, vertices = 0;
  std::size_t timeSensors = 0, interpolators = 0, routes = 0; ///< as in SiteInfo
  std::size_t skins = 0, displacers = 0;                      ///< as in SiteInfo
  bool normals = false, texCoords = false, colors = false;    ///< whether any mesh has them
  std::uint32_t texCoordSets = 0;      ///< the largest number of sets of texture coordinates of a mesh
  std::vector<std::string> attributes; ///< names of further vertex attributes
  Box3d box;
  std::vector<std::string> warnings;
};

/// Reads a file as convert does. `outside`: it may refer to files outside of its folder. Throws Error.
SourceInfo inspectSource(const std::filesystem::path& file, bool outside = false);

} // namespace imgeo
