#include "import/x3d/elevation_grid.h"

namespace imgeo::x3d {

void addElevationGrid(const ElevationGrid& grid, VertexData& data, Faces& faces) {
  const auto& [columns, rows, xSpacing, zSpacing, heights] = grid;
  const bool hasTexCoords = !data.texCoords.empty();
  for (std::uint32_t z = 0; z < rows; ++z)
    for (std::uint32_t x = 0; x < columns; ++x) {
      data.positions.push_back(Vec3f(Vec3d{xSpacing * x, heights[std::size_t{z} * columns + x], zSpacing * z}));
      if (!hasTexCoords)
        data.texCoords.push_back({static_cast<float>(x) / static_cast<float>(columns - 1),
                                  static_cast<float>(z) / static_cast<float>(rows - 1)});
    }
  for (std::uint32_t z = 0; z + 1 < rows; ++z)
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t first = z * columns + x;
      for (const std::uint32_t vertex : {first, first + columns, first + columns + 1, first + 1})
        faces.corners.push_back({vertex, none, none, none});
      faces.ends.push_back(faces.corners.size());
    }
}

} // namespace imgeo::x3d
