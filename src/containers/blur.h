#pragma once
// The operator blur of docs/formats/nodes.md: a filter on the image of a patch's coordinates. The vertices of a grid
// are neighbours on the surface, which becomes smooth. Those of other patches are neighbours by their order alone: the
// filter destroys the shape (paper, section 7.4). web/src/decode/classic/blur.ts does the same; vectors/blur.json binds
// both.

#include "containers/geometry_description.h"
#include "containers/patch_reader.h"

#include <vector>

namespace imgeo {

/// Points in rows of `columns`, of which the last may be shorter.
struct PointImage {
  std::vector<Vec3d> points;
  std::uint32_t columns = 0;
  bool isClosed = false; ///< the last column is joined to the first
};

/// The weighted mean of the neighbours of each point, ceil(radius) to each side along rows and columns, with the
/// weights of a Gaussian whose standard deviation is radius / 2. Near an end of a row or column there are fewer, as
/// many on both sides: corners stay, and a border is filtered along itself, so that surfaces that have the same points
/// there still meet.
std::vector<Vec3d> blurred(const PointImage& image, double radius);

/// The vertices of a patch of SIG classic after its geometry's blur, in the coordinates of the shape.
std::vector<Vec3d> blurredPoints(const IndexedPatch& decoded, const PatchDescription& patch,
                                 const GeometryDescription& geometry, const FetchFile& fetch);

} // namespace imgeo
