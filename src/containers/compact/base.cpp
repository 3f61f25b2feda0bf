#include "containers/compact/base.h"

#include "base/error.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/payload_image.h"
#include "containers/compact/quantise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace imgeo {

namespace {

/// So many steps of a residual are an edge: what rounding moves a vertex by is less
/// than what simplification did.
constexpr double stepsAnEdge = 16;

/// The largest shift of residuals for the edges between positions of one part.
std::uint32_t residualShiftFor(const BaseMesh& base, std::uint32_t positionBits) {
  double sum = 0;
  for (std::size_t corner = 0; corner < base.corners.size(); ++corner) {
    const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    sum += length(Vec3d(base.positions[base.corners[next]]) - Vec3d(base.positions[base.corners[corner]]));
  }
  const double steps = sum / static_cast<double>(base.corners.size()) / stepsAnEdge;
  const auto shift = static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(steps)));
  return std::min(shift == 0 ? 0 : shift - 1, positionBits - 1);
}

} // namespace

compact::CompactPatch baseInIntegers(const BaseMesh& base, const GeometryDescription& geometry,
                                     std::uint32_t colorBits) {
  compact::CompactPatch patch;
  patch.positionBits = geometry.lattice.bits;
  patch.positions = base.positions;
  patch.wedgePositions.resize(base.positions.size());
  std::iota(patch.wedgePositions.begin(), patch.wedgePositions.end(), 0u);
  patch.corners = base.corners;
  patch.parts = base.parts;
  patch.partCount = base.partCount;
  patch.residualShift = residualShiftFor(base, geometry.lattice.bits);
  compact::Attribute normals{{compact::AttributeKind::normal, 3, 8, compact::NormalMode::derivedArea}, {}};
  normals.values.resize(base.positions.size()); // whatever they are, they come from the triangles
  patch.attributes.push_back(std::move(normals));
  if (!base.colors.empty())
    patch.attributes.push_back(compact::colorAttribute(base.colors, base.colorComponents, colorBits));
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
  for (const std::uint32_t wedge : patch.corners)
    base.corners.push_back(patch.wedgePositions[wedge]);
  base.positions = patch.positions;
  base.parts = patch.parts;
  base.partCount = patch.partCount;
  return base;
}

} // namespace imgeo
