#include "containers/compact/base.h"

#include "base/error.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/payload_image.h"
#include "containers/compact/quantise.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace imgeo {

namespace {

/// Residual steps in a mean edge: rounding moves a vertex by less than simplification did.
constexpr double stepsPerEdge = 16;

/// Texture coordinate steps in a mean edge in the texture: simplification moves edges by more than a step.
constexpr double stepsPerTextureEdge = 8;

/// The mean length of the edges of triangles; lengthOf(a, b) measures the edge between two corners.
template <typename LengthOf> double meanEdge(const BaseMesh& base, LengthOf lengthOf) {
  double sum = 0;
  for (std::size_t corner = 0; corner < base.corners.size(); ++corner)
    sum += lengthOf(corner, corner % 3 == 2 ? corner - 2 : corner + 1);
  return sum / static_cast<double>(base.corners.size());
}

/// The residual shift with stepsPerEdge steps in a mean edge.
std::uint32_t residualShiftFor(const BaseMesh& base, std::uint32_t positionBits) {
  const double edge = meanEdge(base, [&](std::size_t a, std::size_t b) {
    return length(Vec3d(base.cornerPosition(b)) - Vec3d(base.cornerPosition(a)));
  });
  const double steps = edge / stepsPerEdge;
  const auto shift = static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(steps)));
  return std::min(shift == 0 ? 0 : shift - 1, positionBits - 1);
}

/// The smallest number of bits, at most `maxBits`, with stepsPerTextureEdge steps in a mean edge.
std::uint32_t texCoordBitsFor(const BaseMesh& base, std::size_t set, const TexCoordBox& box, std::uint32_t maxBits) {
  const std::vector<Vec2f>& texCoords = texCoordsOf(base, set);
  const double edge = meanEdge(base, [&](std::size_t a, std::size_t b) {
    const Vec2f from = texCoords[base.corners[a]], to = texCoords[base.corners[b]];
    return std::hypot(double{to.x} - from.x, double{to.y} - from.y);
  });
  const double steps = stepsPerTextureEdge * std::max(box.size.x, box.size.y) / edge;
  std::uint32_t bits = 1;
  while (bits < maxBits && std::ldexp(1.0, static_cast<int>(bits)) < steps)
    ++bits;
  return bits;
}

/// The smallest number of bits that tells 256 values apart over the range that a base mesh uses.
std::uint32_t bitsFor(const NamedAttribute& named, const AttributeDescription& description) {
  double fraction = 0;
  for (std::uint32_t c = 0; c < named.components && description.size[c] > 0; ++c) {
    double min = named.values[c], max = min;
    for (std::size_t i = c; i < named.values.size(); i += named.components) {
      min = std::min(min, double{named.values[i]});
      max = std::max(max, double{named.values[i]});
    }
    fraction = std::max(fraction, (max - min) / description.size[c]);
  }
  std::uint32_t bits = 8;
  while (bits < 8 * description.bytes && std::ldexp(fraction, static_cast<int>(bits)) < 256)
    ++bits;
  return bits;
}

} // namespace

compact::CompactPatch quantiseBase(const BaseMesh& base, const GeometryDescription& geometry,
                                   std::uint32_t texCoordBits, std::uint32_t colorBits) {
  compact::CompactPatch patch;
  patch.positionBits = geometry.lattice.bits;
  patch.positions = base.positions;
  patch.wedgePositions = base.wedgePositions;
  patch.corners = base.corners;
  patch.segments = base.segments;
  patch.segmentCount = base.segmentCount;
  patch.residualShift = residualShiftFor(base, geometry.lattice.bits);
  compact::Attribute normals{{compact::AttributeKind::normal, 3, 8, compact::NormalMode::derivedArea}, {}};
  // The values are not stored: readers compute normals from the triangles.
  normals.values.resize(base.wedgePositions.size());
  patch.attributes.push_back(std::move(normals));
  for (std::size_t set = 0; set < texCoordSetCount(base); ++set) {
    const TexCoordBox& box = geometry.texCoordBoxes[set];
    patch.attributes.push_back(
        compact::texCoordAttribute(texCoordsOf(base, set), box, texCoordBitsFor(base, set, box, texCoordBits)));
  }
  if (!base.colors.empty())
    patch.attributes.push_back(compact::colorAttribute(base.colors, base.colorComponents, colorBits));
  for (std::size_t i = 0; i < base.namedAttributes.size(); ++i) {
    const NamedAttribute& named = base.namedAttributes[i];
    const AttributeDescription& description = geometry.attributes.at(i);
    patch.attributes.push_back(compact::namedAttribute(named, description, bitsFor(named, description)));
  }
  return patch;
}

EncodedFile baseFile(std::span<const compact::CompactPatch> bases) {
  const Bytes payload = compact::encodePatches(bases, 0).bytes;
  if (payload.size() > compact::maxPayloadBytes)
    throw Error(ErrorKind::limit, "", "a base does not fit into an image; ask for fewer of its triangles");
  return {Role::base, ".png", compact::imageOfPayload(payload)};
}

BaseMesh meshOfBase(const compact::CompactPatch& patch) {
  BaseMesh base;
  base.positions = patch.positions;
  base.wedgePositions = patch.wedgePositions;
  base.corners = patch.corners;
  base.segments = patch.segments;
  base.segmentCount = patch.segmentCount;
  return base;
}

} // namespace imgeo
