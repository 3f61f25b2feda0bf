#pragma once
// Divides the triangles of a level into groups.

#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// The axes along which a level is cut. Levels above one another have different ones, so that borders of groups, where
/// nothing is simplified, do not lie at the same position on both.
enum class GroupFrame : std::uint8_t {
  straight, ///< x, y, z
  turned,   ///< turned by 0.75 radians about (1, 1, 1)
};

/// The triangles of each group, ascending. A KD tree cuts the mesh of triangles, whose positions are lattice points
/// (integers up to 2^24), into groups of at most `maxTriangles`, which are full as far as they can be. The groups are
/// in Morton order of the centres of their boxes. Does not depend on threads.
std::vector<std::vector<std::uint32_t>> groupTriangles(const Mesh& mesh, std::uint32_t maxTriangles, GroupFrame frame);

} // namespace imgeo
