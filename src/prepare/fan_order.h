#pragma once
// An order of triangles in which a vertex and its neighbours come close together.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Breadth-first conquest of a triangle list by fans. Vertices are numbered when
/// they are discovered and processed in that order; processing one emits its
/// triangles that have not come yet, in the counter-clockwise order of its link,
/// the vertex as their first corner.
///
/// `cornerVertices` holds three vertices below `vertexCount` a triangle; any
/// triangles will do (open, non-manifold, inconsistently oriented, degenerate,
/// repeated). Returns corner numbers, three a triangle: every triangle once,
/// turned but never mirrored. Time is O(n log n) in the valence of a vertex, linear
/// in everything else.
std::vector<std::uint32_t> fanOrder(std::span<const std::uint32_t> cornerVertices, std::size_t vertexCount);

} // namespace imgeo
