#pragma once
// Meshes that are a regular grid of heights, such as elevation models.

#include "scene/mesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace imgeo {

/// The vertices of a mesh as rows of a grid: x grows with the column, z with the row, in equal steps.
struct HeightField {
  std::uint32_t columns = 0, rows = 0;
  std::vector<std::uint32_t> wedges; ///< of the mesh, row by row
};

/// The grid that a mesh is, if each of its vertices is on one, each cell has its two triangles, split from the lower
/// left to the upper right vertex, and these are seen from above; otherwise the part of a sentence that says what it
/// lacks.
std::variant<HeightField, std::string> heightFieldOf(const Mesh& mesh);

} // namespace imgeo
