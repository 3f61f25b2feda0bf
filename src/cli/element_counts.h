#pragma once
// Numbers of triangles, lines and points, as commands print them.

#include "imgeo/elements.h"

#include <string>

namespace imgeo::cli {

/// "1,200 triangles, 1 point": all kinds with a count above 0; "0 triangles" if there are none.
std::string listed(const ElementCounts& counts);

} // namespace imgeo::cli
