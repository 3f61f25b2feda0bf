#pragma once
// Files of geometries that have several URLs.

#include "containers/patch_reader.h"
#include "imgeo/error.h"

#include <vector>

namespace imgeo {

/// Leaves every reference that has several URLs the first one whose file can be read and, where it is an image,
/// decoded. Where none can, it leaves the first; an Error for each such file names all its URLs. Safe for untrusted
/// bytes.
std::vector<Error> chooseUrls(GeometryDescription& geometry, const FetchFile& fetch);

} // namespace imgeo
