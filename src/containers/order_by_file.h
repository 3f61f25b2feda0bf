#pragma once
// An order of geometries in which each file is read once.

#include "containers/geometry_description.h"

#include <cstddef>
#include <span>
#include <vector>

namespace imgeo {

/// The indices of geometries, ordered so that those whose first patches are in one file follow one another. Files are
/// in the order of their first geometries, and so are the geometries of a file: a ContainerReader, which keeps a few
/// files, decodes each once.
std::vector<std::size_t> orderByFile(std::span<const GeometryDescription> geometries);

} // namespace imgeo
