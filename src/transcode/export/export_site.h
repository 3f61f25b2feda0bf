#pragma once
// Exports a site to a mesh file: PLY, OBJ or GLB.

#include "imgeo/elements.h"
#include "scene/operators.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

struct ExportReport {
  std::string format; ///< "PLY", "OBJ", "GLB"
  ElementCounts elements;
  std::size_t shapes = 0, vertices = 0;
  std::uint64_t bytes = 0;       ///< size of the written file
  std::size_t lightsLeftOut = 0; ///< GLB: lights that glTF cannot express
  std::size_t routesLeftOut = 0; ///< GLB: ROUTEs whose effect glTF's animations do not have
  /// Geometry nodes of the site's documents of which no mesh can be made, such as Text: how many, by name.
  std::map<std::string, std::size_t> geometryLeftOut;
  /// Switches and LODs, all children of which are written: how many, by name.
  std::map<std::string, std::size_t> choicesWritten;
  /// Faults of geometry nodes that are left out for them: one sentence each.
  std::vector<std::string> warnings;
};

/// Writes the meshes of a site as one mesh file, and those of geometry nodes in its documents (openWholeDocument());
/// the extension of `output` chooses the format (export/export.h). Reads sites of imgeo and of other programs that
/// write X3DOM's containers. `operators` map each mesh after those of its node. Of meshes with levels of detail it
/// writes those of `level`, or their highest. Throws Error; {usage} for an unknown extension, and for a level that no
/// mesh has.
ExportReport exportSite(const std::filesystem::path& site, const std::filesystem::path& output,
                        std::span<const Operator> operators = {}, std::uint32_t level = 0);

/// Writes a frame of a site that plays one sequence as exportSite() writes a mesh. Throws Error{usage} for a site
/// without a sequence and for a number that is not below that of its frames.
ExportReport exportFrame(const std::filesystem::path& site, std::uint32_t frame, const std::filesystem::path& output);

/// The number of frames of the sequence of a site. Throws Error{usage} where it plays none.
std::uint32_t frameCountOf(const std::filesystem::path& site);

} // namespace imgeo
