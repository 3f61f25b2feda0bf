#include "scene/mesh.h"

#include <algorithm>

namespace imgeo {

const char* nameOf(Topology topology) {
  constexpr const char* names[] = {"points", "lines", "triangles"};
  return names[cornersPerElement(topology) - 1];
}

Box3d boxOf(const Mesh& mesh) {
  Box3d box;
  for (const Vec3f& position : mesh.positions)
    box.add(Vec3d(position));
  return box;
}

bool isConsistent(const Mesh& mesh) {
  const auto below = [](std::size_t bound) { return [bound](std::uint32_t index) { return index < bound; }; };
  return isConsistent(mesh, mesh.wedgeCount()) && mesh.corners.size() % cornersPerElement(mesh.topology) == 0 &&
         std::ranges::all_of(mesh.wedgePositions, below(mesh.positions.size())) &&
         std::ranges::all_of(mesh.corners, below(mesh.wedgeCount()));
}

} // namespace imgeo
