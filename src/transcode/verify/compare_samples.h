#pragma once
// Compares the vertices of geometry images with the surface from which they were sampled.

#include "scene/mesh.h"
#include "transcode/verify/attribute_difference.h"

#include <cstddef>
#include <vector>

namespace imgeo {

struct SampleDifference : AttributeDifference {
  std::size_t samples = 0;
  std::size_t beside = 0;          ///< samples that are not on the surface
  std::size_t colorsDiffering = 0; ///< samples whose colours are beyond their bound
};

/// Compares each vertex with the points of the mesh's triangles from which rounding may have moved it, `distance` at
/// most: its attributes may differ from those of one of these points by what their rounding allows. At a crease or a
/// seam there are points of several values. Where a triangle's attributes change within `distance`, the differences are
/// what that change does not explain. The mesh has a triangle; both have the same attributes.
SampleDifference compareSamples(const Mesh& mesh, const std::vector<IndexedPatch>& patches, const Lattice& lattice,
                                double distance, const AttributeBounds& bounds);

} // namespace imgeo
