#pragma once
// The directions and the unit of what Assimp has read.

#include "import/import.h"

#include <string_view>

struct aiScene;

namespace imgeo {

/// Sets the direction that points up, which Assimp brings to y but in some formats, and the length of a unit, where
/// format or file says them. `extension` of the format: in lower case, without its dot.
void addAssimpAxes(const aiScene& scene, std::string_view extension, Imported& imported);

} // namespace imgeo
