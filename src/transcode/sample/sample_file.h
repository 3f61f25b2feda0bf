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

/// Writes such a surface in about `charts` pieces of equal area, 6 .. 6 * 10^6, with texture coordinates: each piece is
/// a rectangle somewhere in the atlas, as photogrammetry makes them, and vertices are repeated along its edges. The
/// image of the atlas is the PNG file of the same name. Throws Error{usage} also where 32 bits cannot number the
/// vertices.
ExportReport writeSampleReliefInCharts(std::uint64_t triangles, std::uint64_t charts, bool shuffled,
                                       const std::filesystem::path& output);

/// Writes a generated soup of boxes (box_soup.h), 1 .. BoxSoup::maxCount, as binary PLY, in constant memory.
/// `shuffled`: boxes in an order without any neighbourhood. Throws Error{usage} if `output` does not end in .ply.
ExportReport writeSampleBoxes(std::uint64_t count, std::uint64_t seed, bool shuffled,
                              const std::filesystem::path& output);

/// Writes a cloud of about so many points, 6 .. 4 * 10^9, of such a surface as binary PLY, in constant memory: at
/// irregular positions, with colours, `intensity` (16 bits) and `classification` (LAS: 2 ground, 5 vegetation). Throws
/// Error{usage} if `output` does not end in .ply.
ExportReport writeSampleCloud(std::uint64_t points, bool shuffled, const std::filesystem::path& output);

} // namespace imgeo
