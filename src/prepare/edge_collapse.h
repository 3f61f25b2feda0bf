#pragma once
// Simplification by edge collapse in the order of the quadric error (Garland and Heckbert, "Surface simplification
// using quadric error metrics", 1997), limited to collapses that keep the topology (Dey et al., "Topology preserving
// edge contraction", 1999).

#include "prepare/quadric.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// A surface that is being simplified.
struct CollapsingSurface {
  struct Vertex {
    Vec3d position;
    Quadric quadric;
    std::uint32_t source = 0;        ///< for the caller; not used here
    bool isFixed = false;            ///< its position does not change
    std::uint32_t mergedInto = none; ///< the vertex with which a collapse has merged it, or none
  };
  static constexpr std::uint32_t none = UINT32_MAX;

  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> corners; ///< three different vertices for each triangle
  std::vector<std::uint32_t> sources; ///< by triangle: for the caller; not used here
};

/// The order of collapses. The quadric error weighs distances by area, so that thin spikes vanish at almost no cost.
enum class CollapseOrder : std::uint8_t {
  quadric,  ///< by the quadric error
  measured, ///< where the two ends of an edge are farther from the triangles that would replace those around them than
            ///< the quadric error says, by that distance; no piece of the surface vanishes
};

/// Collapses edges until `triangleCount` triangles are left or no edge can be collapsed. Two fixed vertices are never
/// merged. Afterwards `corners` and `sources` hold the remaining triangles; vertices keep their indices. Planes
/// through the border's edges keep the border close to its position.
void collapseEdges(CollapsingSurface& surface, std::size_t triangleCount, CollapseOrder order = CollapseOrder::quadric);

} // namespace imgeo
