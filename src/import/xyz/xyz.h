#pragma once
// Point clouds as text, a point on each line: x y z, perhaps a normal, a colour and further values (xyz_columns.h).
// Scanners and programs for point clouds write them under several extensions. Coordinates far from zero are stored
// around an origin, which the document's metadata state (MetadataSet "georeference").

#include "import/import.h"
#include "import/xyz/xyz_columns.h"

#include <array>
#include <string_view>

namespace imgeo {

inline constexpr std::array<std::string_view, 6> xyzExtensions{".xyz", ".txt", ".csv", ".asc", ".pts", ".pwn"};

/// Whether a text begins with points, and is no grid of heights as GDAL reads it: x, y and height of each cell, row by
/// row.
bool resemblesXyz(ByteSpan bytes);

Imported readXyz(ByteSpan bytes, const std::string& name, const ImportOptions& options);

/// The position of a point. Throws Error{malformed} where a coordinate is not a number or beyond single precision.
Vec3d xyzPosition(const NumberLines& lines, std::span<const double> numbers, const XyzColumns& columns);

/// Reads lines of a file of these columns, whose coordinates are stored around the origin of the whole (originOf()).
Imported readXyzAround(const Vec3d& origin, ByteSpan lines, const XyzColumns& columns, const std::string& name,
                       const ImportOptions& options);

} // namespace imgeo
