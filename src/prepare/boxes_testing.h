#pragma once
// Boxes for tests of edges and normals.

#include "scene/testing.h"

#include <array>
#include <initializer_list>

namespace imgeo::testing {

/// Boxes of eight vertices each, of 1 x 2 x 3, in a row.
inline Mesh boxes(std::uint32_t count) {
  Mesh mesh;
  for (std::uint32_t box = 0; box < count; ++box)
    for (const float z : {0.f, 3.f})
      for (const float y : {0.f, 2.f})
        for (const float x : {0.f, 1.f})
          mesh.positions.push_back({x + 2 * static_cast<float>(box), y, z});
  addPlainWedges(mesh);
  for (std::uint32_t box = 0; box < count; ++box)
    for (const auto& [a, b, c, d] : std::initializer_list<std::array<std::uint32_t, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
      const std::uint32_t first = 8 * box;
      addTriangle(mesh, first + a, first + b, first + c);
      addTriangle(mesh, first + a, first + c, first + d);
    }
  return mesh;
}

} // namespace imgeo::testing
