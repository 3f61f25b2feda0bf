#pragma once
// OFF, Geomview's text format (http://www.geomview.org/docs/html/OFF.html): vertices with normals (N), colours (C) and
// texture coordinates (ST), and polygons; without polygons, a cloud of points. Each vertex and polygon is a line. Also
// what other programs write: colours of 0 .. 255 and of three numbers, colours without the C, counts in the line of the
// keyword, and no keyword at all. Colours of polygons are not carried over. Files with four or n coordinates (4OFF,
// nOFF) and binary ones are refused.

#include "import/import.h"

#include <array>
#include <string_view>

namespace imgeo {

inline constexpr std::array<std::string_view, 1> offExtensions{".off"};

/// Whether the first word of a text is the keyword: OFF, perhaps with what vertices have.
bool isOff(ByteSpan bytes);
Imported readOff(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
