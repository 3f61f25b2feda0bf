#include "containers/stored.h"

#include "base/error.h"
#include "base/narrow.h"
#include "containers/encodings.h"
#include "containers/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace imgeo {

Vec2<double> texCoordFraction(const Vec2f& texCoord, const TexCoordBox& box) {
  const auto fraction = [](float value, float min, float size) { return size > 0 ? (double{value} - min) / size : 0; };
  return {fraction(texCoord.x, box.min.x, box.size.x), fraction(texCoord.y, box.min.y, box.size.y)};
}

Vec2f texCoordAt(const Vec2<double>& fraction, const TexCoordBox& box) {
  return {static_cast<float>(box.min.x + box.size.x * fraction.x),
          static_cast<float>(box.min.y + box.size.y * fraction.y)};
}

Vec2<double> texCoordErrorBound(const GeometryDescription& geometry, std::size_t set, std::uint32_t bits) {
  const bool isSig = !hasElementTypes(geometry.encoding);
  const ElementType type = geometry.attributeTypes[texCoordRoles[set]];
  const TexCoordBox& box = geometry.texCoordBoxes[set];
  const double steps = isSig ? std::ldexp(1.0, static_cast<int>(bits)) - 1 : maximumOf(type);
  const bool isExact = !isSig && type == ElementType::float32;
  const auto bound = [&](double low, double size) {
    const double largest = std::max(std::abs(low), std::abs(low + size));
    return (isExact ? 0 : size / steps / 2) + 4 * largest * std::numeric_limits<float>::epsilon() + 1e-30;
  };
  return {bound(box.min.x, box.size.x), bound(box.min.y, box.size.y)};
}

double colorErrorBound(const GeometryDescription& geometry, std::uint32_t bits) {
  const bool isSig = !hasElementTypes(geometry.encoding);
  const ElementType type = geometry.attributeTypes[VertexRole::color];
  const bool isExact = !isSig && type == ElementType::float32;
  const double steps = isSig ? std::ldexp(1.0, static_cast<int>(bits)) - 1 : maximumOf(type);
  return (isExact ? 0 : 0.5 / steps) + 2 * std::numeric_limits<float>::epsilon();
}

Vec3f unitNormal(Vec3d stored) {
  const double norm = length(stored);
  return norm > 0 && std::isfinite(norm) ? Vec3f(stored * (1 / norm)) : Vec3f{0, 0, 1};
}

std::uint64_t drawnCount(std::span<const Draw> draws) {
  std::uint64_t count = 0;
  for (const Draw& draw : draws)
    count += draw.count;
  return count;
}

Box3d boxOf(std::span<const Vec3u> positions, const GeometryDescription& geometry) {
  const bool isFloat = hasElementTypes(geometry.encoding) && geometry.coordType == ElementType::float32;
  Box3d box;
  for (const Vec3u& q : positions) {
    const Vec3d point = geometry.lattice.point(q);
    box.add(isFloat ? Vec3d(Vec3f(point)) : point);
  }
  return box;
}

PatchDescription describePatch(const IndexedPatch& patch, const GeometryDescription& geometry) {
  assert(patch.vertexCount() > 0);
  assert(patch.indices.empty() || geometry.indexType == ElementType::uint32 ||
         patch.vertexCount() <= maxShortIndexedVertices);
  assert(drawnCount(patch.draws) == (patch.indices.empty() ? patch.vertexCount() : patch.indices.size()));
  PatchDescription description;
  description.box = boxOf(patch.positions, geometry);
  description.vertexCount = narrow<std::uint32_t>(patch.vertexCount());
  description.draws = patch.draws;
  return description;
}

std::uint32_t recordCountOf(const PatchDescription& patch, std::span<const std::uint32_t> indices,
                            const std::string& location) {
  if (indices.empty()) {
    const std::uint64_t drawn = drawnCount(patch.draws);
    if (patch.index || drawn == 0)
      throw Error(ErrorKind::malformed, location, "the patch draws nothing");
    if (patch.vertexCount != 0 && drawn > patch.vertexCount)
      throw Error(ErrorKind::malformed, location, "more vertices are drawn than the patch has");
    if (drawn > UINT32_MAX)
      throw Error(ErrorKind::limit, location, "the patch has too many vertices");
    return patch.vertexCount != 0 ? patch.vertexCount : static_cast<std::uint32_t>(drawn);
  }
  const std::uint32_t largest = *std::ranges::max_element(indices);
  if (patch.vertexCount == 0 && largest == UINT32_MAX) // largest + 1 would be 0
    throw Error(ErrorKind::limit, location, "the patch has too many vertices");
  if (patch.vertexCount == 0)
    return largest + 1;
  if (largest >= patch.vertexCount)
    throw Error(ErrorKind::malformed, location,
                "index " + std::to_string(largest) + " is beyond the " + std::to_string(patch.vertexCount) +
                    " vertices of its patch");
  return patch.vertexCount;
}

void checkInsideBox(std::span<const Vec3u> positions, const GeometryDescription& geometry, const Box3d& box,
                    const std::string& location) {
  if (box.empty())
    return;
  const Box3d decoded = boxOf(positions, geometry);
  const double half = 0.51 * geometry.lattice.step; // half a step, and roundings
  for (int axis = 0; axis < 3; ++axis)
    if (decoded.min[axis] < box.min[axis] - half || decoded.max[axis] > box.max[axis] + half)
      throw Error(ErrorKind::malformed, location, "vertices lie outside of the box that their patch states");
}

FileIndex addFile(EncodedPatch& encoded, EncodedFile file) {
  encoded.files.push_back(std::move(file));
  return FileIndex(encoded.files.size() - 1);
}

ElementType indexTypeFor(const PatchedMesh& mesh) {
  const bool isShort = std::ranges::all_of(
      mesh.patches, [](const Patch& patch) { return patch.wedgeCount() <= maxShortIndexedVertices; });
  return isShort ? ElementType::uint16 : ElementType::uint32;
}

bool hasUnitTexCoords(const PatchedMesh& mesh) {
  return std::ranges::all_of(mesh.patches, [](const Patch& patch) {
    return std::ranges::all_of(patch.texCoords, [](const Vec2f& texCoord) {
      return texCoord.x >= 0 && texCoord.y >= 0 && texCoord.x <= 1 && texCoord.y <= 1;
    });
  });
}

} // namespace imgeo
