#pragma once
// Reads the fields of a Transform.

#include "import/x3d/faults.h"
#include "import/x3d/source.h"
#include "scene/scene.h"

#include <vector>

namespace imgeo::x3d {

/// Malformed fields count as absent and are removed from `fields`, those of the element; if strict, throws
/// Error{malformed}.
Transform readTransform(const Source& source, pugi::xml_node element, Faults& faults, std::vector<FieldText>& fields);

} // namespace imgeo::x3d
