#include "containers/compact/compact.h"

#include "base/error.h"
#include "containers/compact/base.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/payload_image.h"
#include "containers/compact/quantise.h"
#include "containers/stored.h"

#include <algorithm>
#include <utility>

namespace imgeo {

namespace {

const Reference& dataOf(const PatchDescription& patch) {
  if (!patch.data)
    throw Error(ErrorKind::malformed, "", "a patch of compact has no data");
  return *patch.data;
}

/// Whether a patch has normals and colours at most once, no more texture coordinates than sets exist, and the further
/// attributes of the geometry in their order.
bool hasAttributes(const compact::CompactPatch& patch, const GeometryDescription& geometry) {
  compact::RoleCounter roles;
  std::size_t others = 0;
  for (const compact::Attribute& attribute : patch.attributes) {
    const compact::AttributeType& type = attribute.type;
    if (type.kind != compact::AttributeKind::other) {
      if (!roles.next(type.kind))
        return false;
      continue;
    }
    if (others == geometry.attributes.size())
      return false;
    const AttributeDescription& description = geometry.attributes[others++];
    if (type.components != description.components || type.bits != 8 * description.bytes)
      return false;
  }
  return others == geometry.attributes.size();
}

/// Checks that a file fits its document.
struct Requirement {
  const std::string& url;
  void operator()(bool condition, const char* message) const {
    if (!condition)
      throw Error(ErrorKind::malformed, url, message);
  }
};

/// The value of the patch that a reference names.
template <typename Value> const Value& valueAt(const std::vector<Value>& values, const Reference& data) {
  const std::uint32_t patchIndex = std::get<PatchLocation>(data.location).patchIndex;
  if (patchIndex >= values.size())
    throw Error(ErrorKind::malformed, data.url,
                "has no patch " + std::to_string(patchIndex) + " but " + std::to_string(values.size()) + " patches");
  return values[patchIndex];
}

} // namespace

compact::CompactPatch quantisePatch(Patch patch, const GeometryDescription& geometry, const EncodeOptions& options) {
  const compact::AttributeBits bits{options.normalBits, options.texCoordBits, options.colorBits,
                                    options.normals == NormalEncoding::derived ? compact::NormalMode::derivedArea
                                                                               : compact::NormalMode::area};
  return compact::quantise(std::move(patch), geometry, bits);
}

PatchDescription describe(const compact::CompactPatch& patch, const GeometryDescription& geometry) {
  PatchDescription description;
  description.box = boxOf(patch.positions, geometry);
  description.vertexCount = static_cast<std::uint32_t>(patch.wedgeCount());
  description.draws = compact::drawsOf(patch);
  return description;
}

EncodedSharedFile encodeCompact(std::span<const compact::CompactPatch> patches, int effort) {
  compact::EncodedPatches encoded = compact::encodePatches(patches, effort);
  if (encoded.bytes.size() > compact::maxPayloadBytes)
    throw Error(ErrorKind::limit, "", "a patch does not fit into an image; use smaller patches");
  return {{Role::patch, ".png", compact::imageOfPayload(encoded.bytes)}, std::move(encoded.normalErrors)};
}

std::shared_ptr<const CompactReader::Patches> CompactReader::patchesOf(const std::string& file) {
  return patches_.get(file, [&](const std::string& url) {
    return compact::decodePatches(compact::payloadOfImage(fetch_(url), url), url);
  });
}

IndexedPatch CompactReader::decode(const PatchDescription& patch, const GeometryDescription& geometry) {
  const Reference& data = dataOf(patch);
  const auto patches = patchesOf(data.url);
  const compact::CompactPatch& decoded = valueAt(*patches, data);
  const Requirement require{data.url};
  require(decoded.segmentCount == 0 || geometry.levels, "a base stands where a patch should");
  require(decoded.positionBits == geometry.lattice.bits, "the positions have other bits than the node states");
  require(patch.vertexCount == 0 || patch.vertexCount == decoded.wedgeCount(),
          "the patch has other vertices than the document states");
  require(hasAttributes(decoded, geometry), "the patch has other attributes than the document states");
  require(patch.draws == compact::drawsOf(decoded), "the patch has other elements than the document states");
  IndexedPatch vertices = compact::verticesOf(decoded, geometry);
  checkInsideBox(vertices.positions, geometry, patch.box, data.url);
  return vertices;
}

BaseMesh CompactReader::decodeBase(const GeometryDescription& geometry) {
  const Reference& reference = geometry.base.value();
  const auto bases = patchesOf(reference.url);
  const compact::CompactPatch& base = valueAt(*bases, reference);
  const Requirement require{reference.url};
  require(base.segmentCount > 0, "a patch stands where a base should");
  require(base.segmentCount == geometry.patches.size(), "the base has other segments than the node has patches");
  require(base.positionBits == geometry.lattice.bits, "the positions have other bits than the node states");
  return meshOfBase(base);
}

StoredPrecision CompactReader::precisionOf(const GeometryDescription& geometry) {
  if (geometry.patches.empty())
    return {};
  const Reference& data = dataOf(geometry.patches[0]);
  const auto types = types_.get(data.url, [&](const std::string& url) {
    return compact::attributesOfPatches(compact::payloadOfImage(fetch_(url), url), url);
  });
  StoredPrecision precision;
  compact::RoleCounter roles;
  for (const compact::AttributeType& type : valueAt(*types, data)) {
    if (const std::optional<VertexRole> role = roles.next(type.kind))
      precision.bits[*role] = type.bits;
    if (type.kind == compact::AttributeKind::normal)
      precision.normalEncoding = type.isDerived() ? NormalEncoding::derived : NormalEncoding::octahedral;
  }
  return precision;
}

} // namespace imgeo
