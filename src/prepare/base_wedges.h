#pragma once
// Which wedges a simplified patch has. Its vertices stand for many of the patch's, and
// where the texture has a seam among these, for pieces of surface that lie apart in the
// texture. Each piece becomes a wedge, so that no triangle stretches from one to another.

#include "prepare/patches.h"
#include "prepare/simplify.h"

#include <span>

namespace imgeo {

struct SimplifiedWedges {
  std::vector<std::uint32_t> positions; ///< wedge -> position of the simplified triangles
  std::vector<std::uint32_t> sources;   ///< wedge -> wedge of the patch whose attributes it has
  std::vector<std::uint32_t> corners;   ///< corner of the simplified triangles -> wedge
};

/// `triangles` says for each of the simplifier's input which of the patch it was. Without
/// texture coordinates each position has one wedge, with them one for pieces that lie within a
/// quarter of an edge in the texture. A wedge has the attributes of the nearest of those that
/// it stands for.
SimplifiedWedges wedgesOf(const SimplifiedTriangles& simplified, const Patch& patch,
                          std::span<const std::uint32_t> triangles);

} // namespace imgeo
