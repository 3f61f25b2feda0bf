#pragma once
// The steps between import and the lattice, which `verify` must repeat exactly
// as `convert` took them.

#include "import/import.h"
#include "prepare/normals.h"
#include "prepare/weld.h"
#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace imgeo {

/// Geometry of X3D documents stays in them where its text is no longer than this, which
/// is between the best for hosts that compress and for those that do not, and there is
/// not too much of it: docs/decisions/scenes.md has the measurements.
inline constexpr std::size_t inlineBytes = 1024;

/// Imports a file, or standard input for "-", and says how long it is.
Imported importInput(const std::filesystem::path& input, const ImportOptions& options, std::uint64_t& bytes);

/// The input in messages.
std::string locationOf(const std::filesystem::path& input);

struct PreparationReport {
  WeldReport weld;              ///< summed over the meshes
  bool normalsComputed = false; ///< for at least one mesh
  std::vector<std::string> warnings;
};

/// Welds every mesh, drops what is to be dropped and what no element uses, gives normals to triangle meshes
/// that bring none, and drops shapes in which nothing is left to see. Throws
/// Error{malformed} naming `location` where that leaves an empty scene.
PreparationReport prepareScene(Scene& scene, const DroppedElements& dropped, NormalWeighting weighting,
                               const std::string& location);

} // namespace imgeo
