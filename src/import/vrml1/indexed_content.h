#pragma once
// The corners of an IndexedFaceSet, IndexedLineSet or PointSet of VRML 1.0, and what they use of the current
// coordinates, normals, texture coordinates and materials.

#include "import/vrml1/appearances.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo::vrml1 {

inline constexpr std::size_t noIndex = static_cast<std::size_t>(-1);
using Indices = std::vector<std::size_t>;

/// The corners of one face or polyline, or of all points: those of coordIndex from `begin` up to `end`. `number` counts
/// the runs of a node from 0.
struct Run {
  std::size_t begin = 0, end = 0, number = 0;
};

/// The corners of a node and what they use. Attributes have an index for each corner of coordIndex, or noIndex.
struct IndexedContent {
  bool isSurface = false, isPoints = false, isTextured = false;
  Indices coordIndex;
  std::vector<Run> runs;    ///< without degenerate ones
  std::vector<Run> allRuns; ///< with degenerate ones, which bindings count too
  const std::vector<double>*points = nullptr, *normals = nullptr, *texCoords = nullptr; ///< null: none
  Indices normalIndex, texCoordIndex;
  Indices materialIndex;       ///< of each corner; empty where one material is bound to all
  bool isMaterialByRun = true; ///< whether the corners of a run have the same material
  Surfaces surfaces{nullptr};
  const Node* hints = nullptr;
  std::string key; ///< equal for contents whose geometries are equal but for colours

  std::size_t materialOf(std::size_t corner) const {
    return materialIndex.empty() ? 0 : materialIndex[corner] % surfaces.count();
  }
};

/// Reads a node. Empty where it has no face, line or point, and after an index out of range has been reported.
std::optional<IndexedContent> readIndexedContent(const Node& node, Properties& properties,
                                                 const x3d::VrmlTokens& tokens, Report& report);

} // namespace imgeo::vrml1
