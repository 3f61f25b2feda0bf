#pragma once
// A triangle order with locality: the triangles of a vertex, and those of its neighbours, come close together.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Traverses a triangle list breadth first, fan by fan. Vertices are numbered when they are discovered, and processed
/// in that order. Processing a vertex emits its remaining triangles in the counter-clockwise order of its link, with
/// the vertex as their first corner.
///
/// `cornerVertices` holds three vertices below `vertexCount` for each triangle. Triangles may be open, non-manifold,
/// inconsistently oriented, degenerate or repeated. Returns indices of corners, three for each triangle: every
/// triangle once, rotated but not mirrored. Time is O(n log n) in the valence of a vertex and linear in the number of
/// triangles.
std::vector<std::uint32_t> fanOrder(std::span<const std::uint32_t> cornerVertices, std::size_t vertexCount);

} // namespace imgeo
