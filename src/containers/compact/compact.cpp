#include "containers/compact/compact.h"

#include "base/error.h"
#include "containers/compact/header.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/payload_image.h"
#include "containers/compact/quantise.h"
#include "containers/stored.h"

#include <algorithm>

namespace imgeo {

namespace {

const Reference& dataOf(const PatchDescription& patch) {
  if (!patch.data)
    throw Error(ErrorKind::malformed, "", "a patch of compact has no data");
  return *patch.data;
}

/// Every kind at most once, but for the geometry's further attributes, in their order.
bool hasAttributes(const compact::CompactPatch& patch, const GeometryDescription& geometry) {
  std::size_t kinds[3] = {}, others = 0;
  for (const compact::Attribute& attribute : patch.attributes) {
    const compact::AttributeType& type = attribute.type;
    if (type.kind != compact::AttributeKind::other) {
      if (++kinds[static_cast<std::size_t>(type.kind)] > 1)
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

PatchDescription describe(const compact::CompactPatch& patch, const GeometryDescription& geometry) {
  PatchDescription description;
  description.box = boxOf(patch.positions, geometry);
  description.vertexCount = static_cast<std::uint32_t>(patch.wedgeCount());
  description.draws = compact::drawsOf(patch);
  return description;
}

} // namespace

EncodedPatch encodeCompact(const Patch& patch, const GeometryDescription& geometry,
                           const EncodeOptions& options) {
  const compact::AttributeBits bits{options.normalBits, options.texCoordBits, options.colorBits,
                                    options.normals == NormalEncoding::derived
                                        ? compact::NormalMode::derivedArea
                                        : compact::NormalMode::area};
  const compact::CompactPatch quantised = compact::quantise(patch, geometry, bits);
  const auto [payload, normalError] = compact::encodePatchBytes(quantised, options.effort);
  if (payload.size() > compact::maxPayloadBytes)
    throw Error(ErrorKind::limit, "", "a patch does not fit into an image; use smaller patches");
  EncodedPatch encoded{describe(quantised, geometry), {}, normalError};
  encoded.description.data = addFile(encoded, {Role::patch, ".png", compact::imageOfPayload(payload)});
  return encoded;
}

IndexedPatch decodeCompact(const PatchDescription& patch, const GeometryDescription& geometry,
                           const FetchFile& fetch) {
  const Reference& data = dataOf(patch);
  const Bytes payload = compact::payloadOfImage(fetch(data.url), data.url);
  const compact::CompactPatch decoded = compact::decodePatchBytes(payload, data.first, data.url);
  const auto require = [&](bool condition, const char* message) {
    if (!condition)
      throw Error(ErrorKind::malformed, data.url, message);
  };
  require(decoded.partCount == 0, "a base stands where a patch should");
  require(decoded.positionBits == geometry.lattice.bits,
          "the positions have other bits than the node states");
  require(patch.vertexCount == 0 || patch.vertexCount == decoded.wedgeCount(),
          "the patch has other vertices than the document states");
  require(hasAttributes(decoded, geometry), "the patch has other attributes than the document states");
  require(patch.draws == compact::drawsOf(decoded), "the patch has other elements than the document states");
  IndexedPatch vertices = compact::verticesOf(decoded, geometry);
  checkInsideBox(vertices.positions, geometry, patch.box, data.url);
  return vertices;
}

StoredPrecision precisionOfCompact(const PatchDescription& patch, const FetchFile& fetch) {
  const Reference& data = dataOf(patch);
  const Bytes payload = compact::payloadOfImage(fetch(data.url), data.url);
  StoredPrecision precision;
  for (const compact::AttributeType& type :
       compact::readHeader(payload, data.first, data.url).header.attributes)
    switch (type.kind) {
    case compact::AttributeKind::normal:
      precision.normalBits = type.bits;
      precision.normalEncoding = type.isDerived() ? NormalEncoding::derived : NormalEncoding::octahedral;
      break;
    case compact::AttributeKind::texCoord:
      precision.texCoordBits = type.bits;
      break;
    case compact::AttributeKind::color:
      precision.colorBits = type.bits;
      break;
    case compact::AttributeKind::other:
      break;
    }
  return precision;
}

} // namespace imgeo
