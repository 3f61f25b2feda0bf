#pragma once
// Compares shapes that the site shows as others, moved and turned, with what the input has.

#include "imgeo/verify.h"
#include "scene/scene.h"
#include "scene/stored_meshes.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace imgeo {

/// Where a shape is, in the site and in the input.
struct ShapePair {
  std::size_t geometry = 0; ///< index into the site's geometries
  std::size_t mesh = 0;     ///< index into the input's meshes
  Affine3d worldFromSite, worldFromInput;
  bool hasSameTransform = false; ///< within the rounding of documents
};

enum class ShapeMatch : std::uint8_t {
  source,   ///< the geometry has been made of this mesh
  instance, ///< it has been made of another one, and shows this one
  moved,    ///< neither
};

/// What each shape of the site is. A geometry has been made of the mesh of the first shape in the order of the document
/// that has the same transform in both. Another mesh equals it, moved as the site moves it, if each of its elements has
/// one with the same attributes, normals within a ninth of a degree, and vertices within `stated` and the rounding of
/// documents; nothing is an instance without `stated`. Adds what it measures to the report.
std::vector<ShapeMatch> matchShapes(const std::vector<ShapePair>& shapes, const SceneMeshes& meshes,
                                    std::optional<double> stated, VerifyReport& report);

/// The length within which two transforms of a box count as equal, by the rounding of documents.
double transformSlack(const Affine3d& map, const Box3d& box);

} // namespace imgeo
