#pragma once
// Numbers of triangles, lines and points, as commands print them.

#include "imgeo/elements.h"

#include <string>

namespace imgeo::cli {

/// "1,200 triangles, 1 point": the kinds of which there are any; "0 triangles"
/// where there are none.
std::string listed(const ElementCounts& counts);

} // namespace imgeo::cli
