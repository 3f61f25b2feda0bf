#pragma once
// Maps the vertices of a site or mesh file by operators, and writes them as a mesh file.

#include "transcode/export/export_site.h"

#include <string>
#include <vector>

namespace imgeo {

struct TransformReport {
  ExportReport written;
  std::vector<std::string> warnings; ///< what of the input is not carried over
};

/// Writes `input` as PLY, OBJ or GLB, by the extension of `output`, with its vertices mapped by `operators` as a page
/// of `imgeo convert INPUT` draws them with that field: each mesh in the cube over the longest edge of its box, from
/// its minimum. `input` is a site's directory, which is read as exportSite() does, or a file of any format that is
/// imported;
/// "-" reads standard input. `outside`: a file may refer to files outside of its folder. Throws Error; {usage} for
/// operators that cannot be read and for an unknown extension.
TransformReport transformFile(const std::filesystem::path& input, const std::filesystem::path& output,
                              const std::string& operators, bool outside);

} // namespace imgeo
