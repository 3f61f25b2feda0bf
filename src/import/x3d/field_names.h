#pragma once
// The names of X3D's fields, for documents whose names have lost their case, as in HTML.

#include <string_view>

namespace imgeo::x3d {

/// X3D's name of a field whose letters may be in another case: "coordIndex" for "coordindex". Names that are no field's
/// stay as they are.
std::string_view fieldNameOf(std::string_view attribute);

} // namespace imgeo::x3d
