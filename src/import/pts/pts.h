#pragma once
// PTS point clouds (Leica Cyclone): for each scan a line with the number of its points, then a line for each point: x y
// z, perhaps its intensity, perhaps red, green and blue of 0 .. 255. Each scan is a shape. Coordinates far from zero
// are stored around an origin, which the document's metadata state (MetadataSet "georeference").

#include "import/import.h"

#include <array>
#include <string_view>

namespace imgeo {

inline constexpr std::array<std::string_view, 1> ptsExtensions{".pts"};

Imported readPts(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
