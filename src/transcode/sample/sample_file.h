#pragma once
// Writes a generated scene to a mesh file.

#include "transcode/export/export_site.h"

namespace imgeo {

/// Writes a generated hall (sample_hall.h) as GLB. The report counts every instance of a shape. Throws Error{usage} if
/// `output` does not end in .glb.
ExportReport writeSampleHall(std::uint32_t seats, const std::filesystem::path& output);

} // namespace imgeo
