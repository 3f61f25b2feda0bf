#pragma once
// The wedges of a simplified patch. Each simplified vertex replaces many vertices of the patch. If a texture seam runs
// between these, they belong to several charts of the texture; each chart becomes a wedge, so that no triangle is
// stretched across the seam.

#include "prepare/patches.h"
#include "prepare/simplify.h"

#include <span>

namespace imgeo {

/// Whether base meshes have an attribute. They lack normals, which readers compute from the triangles.
constexpr bool isInBase(VertexRole role) {
  return role != VertexRole::normal;
}

/// Whether creases, where several wedges of a position have different normals, remain in a simplified patch.
enum class Creases : std::uint8_t { smoothed, kept };

struct SimplifiedWedges {
  std::vector<std::uint32_t> positions; ///< wedge -> position of the simplified triangles
  std::vector<std::uint32_t> sources;   ///< wedge -> the patch's wedge whose attributes it has
  std::vector<std::uint32_t> corners;   ///< corner of the simplified triangles -> wedge
};

/// `triangles` maps each triangle of the simplifier's input to its index in the patch. Without texture coordinates
/// each position has one wedge. With them, pieces of surface share a wedge where their texture coordinates are within
/// a quarter of the mean edge length in the texture. A wedge has the attributes of the nearest wedge that it replaces.
/// With `Creases::kept`, which has an effect on patches with normals, they share one only where their normals differ by
/// less than 30 degrees.
SimplifiedWedges wedgesOf(const SimplifiedTriangles& simplified, const Patch& patch,
                          std::span<const std::uint32_t> triangles, Creases creases = Creases::smoothed);

} // namespace imgeo
