#pragma once
// A page that draws a live stream.

#include "base/vec.h"

#include <filesystem>
#include <string>

namespace imgeo {

/// Writes a page with its runtime into an empty folder: it draws the stream live/NAME of the server that serves the
/// folder, coloured by the stream's values, and shows `box`. `viewToken`: of the stream; empty: none. Throws Error{io}.
void writeLivePage(const std::filesystem::path& folder, const std::string& name, const Box3d& box,
                   const std::string& viewToken);

} // namespace imgeo
