#pragma once
// Divides the triangles of a level into groups.

#include "prepare/levels/group_frame.h"
#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// The triangles of each group, ascending. KD trees cut each of the lists `regions`, which divide the triangles of a
/// mesh, into groups of at most `maxTriangles`, which are full as far as they can be. Positions are lattice points
/// (integers up to 2^24). The groups of a region are in Morton order of the centres of their boxes, and behind those of
/// the regions before it. Does not depend on threads.
std::vector<std::vector<std::uint32_t>> groupTriangles(const Mesh& mesh,
                                                       std::vector<std::vector<std::uint32_t>> regions,
                                                       std::uint32_t maxTriangles, GroupFrame frame);

} // namespace imgeo
