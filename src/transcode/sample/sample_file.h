#pragma once
// Writes a generated scene to a mesh file.

#include "transcode/export/export_site.h"

namespace imgeo {

/// Writes a generated hall (sample_hall.h) as GLB. The report counts every instance of a shape. Throws Error{usage} if
/// `output` does not end in .glb.
ExportReport writeSampleHall(std::uint32_t seats, const std::filesystem::path& output);

/// Writes a generated closed surface (relief_surface.h) of about so many triangles, 12 .. 8 * 10^9, as binary PLY, in
/// constant memory. `shuffled`: vertices and triangles in an order without any neighbourhood. Throws Error{usage} if
/// `output` does not end in .ply.
ExportReport writeSampleRelief(std::uint64_t triangles, bool shuffled, const std::filesystem::path& output);

/// Writes a cloud of about so many points, 6 .. 4 * 10^9, of such a surface as binary PLY, in constant memory: at
/// irregular positions, with colours, `intensity` (16 bits) and `classification` (LAS: 2 ground, 5 vegetation). Throws
/// Error{usage} if `output` does not end in .ply.
ExportReport writeSampleCloud(std::uint64_t points, bool shuffled, const std::filesystem::path& output);

} // namespace imgeo
