#pragma once
// Which meshes of a source are converted out of core.

#include "imgeo/convert.h"
#include "import/chunks/chunked_source.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// The numbers of the meshes of a source that are converted out of core, if any of it is: those that get levels and
/// have more triangles or points than a region. `options` are resolved.
std::vector<std::size_t> largeMeshes(const ChunkedSource& source, const ConvertOptions& options);

/// The triangles and points of meshes of a source.
std::uint64_t elementsOf(const ChunkedSource& source, std::span<const std::size_t> meshes);

} // namespace imgeo
