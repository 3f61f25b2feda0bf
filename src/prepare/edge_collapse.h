#pragma once
// Edges collapse, the least harmful first: Garland and Heckbert, "Surface
// simplification using quadric error metrics", 1997, where that leaves the surface
// what it is (Dey et al., "Topology preserving edge contraction", 1999).

#include "prepare/quadric.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// A surface that is being simplified.
struct CollapsingSurface {
  struct Vertex {
    Vec3d place;
    Quadric quadric;
    std::uint32_t source = 0;    ///< whatever the caller wants to know of it
    bool isFixed = false;        ///< stays where it is
    std::uint32_t became = none; ///< the vertex that it is now part of, if it is another
  };
  static constexpr std::uint32_t none = UINT32_MAX;

  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> corners; ///< three vertices a triangle, all different
  std::vector<std::uint32_t> sources; ///< per triangle: whatever the caller wants to know of it
};

/// Collapses edges until `triangleCount` are left or none can go; two fixed vertices
/// never become one. Then triangles that are left alone stand in `corners`, with their
/// `sources`; vertices keep their numbers. Edges of the border are held by planes of their own.
void collapseEdges(CollapsingSurface& surface, std::size_t triangleCount);

} // namespace imgeo
