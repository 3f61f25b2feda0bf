#include "containers/bg/bg.h"

#include "base/error.h"
#include "base/narrow.h"
#include "containers/named_attributes.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

/// The records of one attribute: `components` elements each, `stride` bytes apart.
class Records {
public:
  Records(const Reference& reference, const FetchFile& fetch, ElementType type, std::uint32_t components)
      : bytes_(fetch(reference.url)), location_(reference.url), type_(type),
        recordBytes_(std::uint64_t{components} * byteSizeOf(type)) {
    const ByteLocation& begin = std::get<ByteLocation>(reference.location);
    byteOffset_ = begin.byteOffset;
    stride_ = begin.byteStride != 0 ? begin.byteStride : recordBytes_;
    if (stride_ < recordBytes_)
      throw Error(ErrorKind::malformed, location_,
                  "a stride of " + std::to_string(stride_) + " bytes is less than a record of " +
                      std::to_string(components) + " " + nameOf(type));
  }

  /// Throws Error{truncated} unless the file holds records 0 .. count - 1. Call it before reading them.
  void require(std::uint64_t count) const {
    // Interleaved records begin before this attribute, and all are whole. The check divides, since products of numbers
    // that the document states could overflow.
    const std::uint64_t begin = byteOffset_ - byteOffset_ % stride_;
    if (begin > bytes_.size() || (bytes_.size() - begin) / stride_ < count || available() < count)
      throw Error(ErrorKind::truncated, location_,
                  std::to_string(bytes_.size()) + " bytes are too few for " + std::to_string(count) + " records of " +
                      std::to_string(stride_) + " bytes from byte " + std::to_string(byteOffset_));
  }

  /// The number of records up to the end of the file.
  std::uint64_t available() const {
    return byteOffset_ + recordBytes_ > bytes_.size() ? 0 : (bytes_.size() - byteOffset_ - recordBytes_) / stride_ + 1;
  }

  std::uint32_t unsignedAt(std::uint64_t record, std::uint32_t component) const {
    const std::uint8_t* at = this->at(record, component);
    switch (byteSizeOf(type_)) {
    case 1:
      return *at;
    case 2:
      return loadLittle<std::uint16_t>(at);
    default:
      return loadLittle<std::uint32_t>(at);
    }
  }

  std::int64_t integerAt(std::uint64_t record, std::uint32_t component) const {
    const std::uint8_t* at = this->at(record, component);
    switch (type_) {
    case ElementType::int8:
      return static_cast<std::int8_t>(*at);
    case ElementType::int16:
      return loadLittle<std::int16_t>(at);
    case ElementType::int32:
      return loadLittle<std::int32_t>(at);
    case ElementType::uint8:
    case ElementType::uint16:
    case ElementType::uint32:
    case ElementType::float32:
      break;
    }
    return unsignedAt(record, component);
  }

  /// An element as shaders read it: integers as fractions of their type's maximum.
  double realAt(std::uint64_t record, std::uint32_t component) const {
    if (type_ == ElementType::float32)
      return loadLittle<float>(at(record, component));
    return static_cast<double>(integerAt(record, component)) / maximumOf(type_);
  }

private:
  const std::uint8_t* at(std::uint64_t record, std::uint32_t component) const {
    return &bytes_[byteOffset_ + record * stride_ + std::size_t{component} * byteSizeOf(type_)];
  }

  Bytes bytes_;
  std::string location_;
  ElementType type_;
  std::uint64_t byteOffset_, recordBytes_, stride_;
};

void requireType(bool supported, const std::string& location, const char* attribute, ElementType type) {
  if (!supported)
    throw Error(ErrorKind::unsupported, location, std::string(attribute) + " of type " + nameOf(type));
}

/// A count of 0 in a single draw stands for all indices of the file.
std::vector<std::uint32_t> decodeIndices(const PatchDescription& patch, ElementType type, const FetchFile& fetch) {
  requireType(isUnsigned(type), patch.index->url, "indices", type);
  const Records records(*patch.index, fetch, type, 1);
  const bool all = patch.draws.size() == 1 && patch.draws[0].count == 0;
  const std::uint64_t count = all ? records.available() : drawnCount(patch.draws);
  records.require(count);
  std::vector<std::uint32_t> indices(count);
  for (std::uint64_t n = 0; n < count; ++n)
    indices[n] = records.unsignedAt(n, 0);
  return indices;
}

/// The patch with the number of records that its file holds, where it has no index and its single draw has a count of
/// 0.
PatchDescription withCount(PatchDescription patch, ElementType coordType, const FetchFile& fetch) {
  if (patch.index || patch.draws.size() != 1 || patch.draws[0].count != 0)
    return patch;
  const std::uint64_t available = Records(patch.coord[0], fetch, coordType, 3).available();
  patch.draws[0].count = patch.vertexCount != 0
                             ? patch.vertexCount
                             : static_cast<std::uint32_t>(std::min<std::uint64_t>(available, UINT32_MAX));
  return patch;
}

std::vector<Vec3u> decodeIntegers(const Records& records, std::uint32_t count, const GeometryDescription& geometry,
                                  const std::string& location) {
  const StoredCoords stored = storedCoords(Encoding::bg, geometry.coordType, geometry.lattice.bits);
  std::vector<Vec3u> positions(count);
  for (std::uint32_t n = 0; n < count; ++n)
    for (int axis = 0; axis < 3; ++axis)
      if (geometry.lattice.stretch[axis] > 0) // on a flat axis all numbers mean the same coordinate
        positions[n][axis] = loadCoord(records.integerAt(n, static_cast<std::uint32_t>(axis)), stored, location);
  return positions;
}

Vec3f floatAt(const Records& coords, std::uint32_t n) {
  return Vec3f(Vec3d{coords.realAt(n, 0), coords.realAt(n, 1), coords.realAt(n, 2)});
}

std::vector<Vec3u> decodeFloats(const Records& records, std::uint32_t count, const Lattice& lattice,
                                const std::string& location) {
  std::vector<Vec3u> positions;
  for (std::uint32_t n = 0; n < count; ++n)
    positions.push_back(nearestPoint(floatAt(records, n), lattice, location));
  return positions;
}

std::vector<Vec3f> decodeNormals(const Records& records, std::uint32_t count, const GeometryDescription& geometry) {
  std::vector<Vec3f> normals(count);
  const std::uint32_t bits = 8 * byteSizeOf(geometry.attributeTypes[VertexRole::normal]);
  for (std::uint32_t n = 0; n < count; ++n)
    normals[n] = isPair(geometry.normalEncoding)
                     ? loadNormal({records.unsignedAt(n, 0), records.unsignedAt(n, 1)}, geometry.normalEncoding, bits)
                     : unitNormal({records.realAt(n, 0), records.realAt(n, 1), records.realAt(n, 2)});
  return normals;
}

std::vector<Vec2f> decodeTexCoords(const Records& records, std::uint32_t count, const TexCoordBox& box) {
  std::vector<Vec2f> texCoords;
  for (std::uint32_t n = 0; n < count; ++n)
    texCoords.push_back(texCoordAt({records.realAt(n, 0), records.realAt(n, 1)}, box));
  return texCoords;
}

std::vector<Rgba> decodeColors(const Records& records, std::uint32_t count, std::uint32_t components) {
  const auto channel = [&](std::uint32_t n, std::uint32_t component) {
    const double fraction = records.realAt(n, component);
    return static_cast<float>(fraction >= 0 ? std::min(fraction, 1.0) : 0); // NaN becomes 0
  };
  std::vector<Rgba> colors;
  for (std::uint32_t n = 0; n < count; ++n)
    colors.emplace_back(channel(n, 0), channel(n, 1), channel(n, 2), components == 4 ? channel(n, 3) : 1);
  return colors;
}

/// The number of elements in a record.
std::uint32_t storedComponents(VertexRole role, const GeometryDescription& geometry) {
  switch (role) {
  case VertexRole::normal:
    return isPair(geometry.normalEncoding) ? 2 : 3;
  case VertexRole::texCoord:
  case VertexRole::texCoord1:
  case VertexRole::texCoord2:
  case VertexRole::texCoord3:
    return 2;
  case VertexRole::color:
    break;
  }
  return geometry.colorComponents;
}

void decodeInto(IndexedPatch& decoded, VertexRole role, const Records& records, std::uint32_t count,
                const GeometryDescription& geometry) {
  switch (role) {
  case VertexRole::normal:
    decoded.normals = decodeNormals(records, count, geometry);
    break;
  case VertexRole::texCoord:
  case VertexRole::texCoord1:
  case VertexRole::texCoord2:
  case VertexRole::texCoord3:
    texCoordsOf(decoded, texCoordSetOf(role)) =
        decodeTexCoords(records, count, geometry.texCoordBoxes[texCoordSetOf(role)]);
    break;
  case VertexRole::color:
    decoded.colors = decodeColors(records, count, geometry.colorComponents);
    break;
  }
}

NamedAttribute decodeAttribute(const Records& records, std::uint32_t count, const AttributeDescription& description,
                               const std::string& location) {
  NamedAttribute attribute{description.name, description.components, {}};
  for (std::uint32_t n = 0; n < count; ++n)
    for (std::uint32_t c = 0; c < description.components; ++c) {
      attribute.values.push_back(static_cast<float>(records.realAt(n, c)));
      if (!std::isfinite(attribute.values.back()))
        throw Error(ErrorKind::malformed, location, "an attribute is not a number");
    }
  return attribute;
}

void checkTypes(const PatchDescription& patch, const GeometryDescription& geometry) {
  if (patch.coord.size() != 1)
    throw Error(ErrorKind::malformed, "", "a BinaryGeometry patch has one file of coordinates");
  const std::string& location = patch.coord[0].url;
  if (!holdsLattice(geometry.coordType, geometry.lattice.bits))
    throw Error(ErrorKind::malformed, location,
                std::string(nameOf(geometry.coordType)) + " is no type for coordinates of " +
                    std::to_string(geometry.lattice.bits) + " bits");
  const std::optional<Reference>& normal = patch.vertexAttributes[VertexRole::normal];
  const ElementType normalType = geometry.attributeTypes[VertexRole::normal];
  if (normal && isPair(geometry.normalEncoding))
    requireType(normalType == ElementType::uint8 || normalType == ElementType::uint16, normal->url,
                "normals of two numbers", normalType);
  else if (normal)
    requireType(!isUnsigned(normalType), normal->url, "normals", normalType);
}

} // namespace

Lattice findBgLattice(const GeometryDescription& geometry, const FetchFile& fetch) {
  if (geometry.coordType != ElementType::float32 || geometry.lattice.bits != sourceBits)
    return geometry.lattice;
  Box3d box;
  bool fits = true;
  for (const PatchDescription& stated : geometry.patches) {
    checkTypes(stated, geometry);
    const PatchDescription patch = withCount(stated, geometry.coordType, fetch);
    const std::string& location = patch.coord[0].url;
    const std::vector<std::uint32_t> indices =
        patch.index ? decodeIndices(patch, geometry.indexType, fetch) : std::vector<std::uint32_t>();
    const std::uint32_t count = recordCountOf(patch, indices, patch.index ? patch.index->url : location);
    const Records coords(patch.coord[0], fetch, geometry.coordType, 3);
    coords.require(count);
    for (std::uint32_t n = 0; n < count; ++n) {
      const Vec3f position = floatAt(coords, n);
      if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
        throw Error(ErrorKind::malformed, location, "a coordinate is not a number");
      fits = fits && isInside(position, geometry.lattice);
      box.add(Vec3d(position));
    }
  }
  constexpr double maxExcess = 4; // in a larger cube, whose steps are coarser, floats would lose precision; ours has 2
  const double edge = box.longestEdge(), stated = geometry.lattice.step * geometry.lattice.maximum();
  if (fits && edge > 0 && stated <= maxExcess * edge)
    return geometry.lattice;
  const double half = edge > 0 ? edge / 2 : 1;
  return latticeOf({box.center(), {half, half, half}}, Encoding::bg, ElementType::float32, sourceBits);
}

IndexedPatch decodeBg(const PatchDescription& stated, const GeometryDescription& geometry, const FetchFile& fetch) {
  checkTypes(stated, geometry);
  const PatchDescription patch = withCount(stated, geometry.coordType, fetch);
  const std::string& location = patch.coord[0].url;
  IndexedPatch decoded;
  decoded.draws = patch.draws;
  decoded.colorComponents = geometry.colorComponents;
  if (patch.index) {
    decoded.indices = decodeIndices(patch, geometry.indexType, fetch);
    if (decoded.draws.size() == 1)
      decoded.draws[0].count = narrow<std::uint32_t>(decoded.indices.size());
  }
  const std::uint32_t count = recordCountOf(patch, decoded.indices, patch.index ? patch.index->url : location);
  const auto fetchRecords = [&](const Reference& reference, ElementType type, std::uint32_t components) {
    Records records(reference, fetch, type, components);
    records.require(count);
    return records;
  };

  const Records coords = fetchRecords(patch.coord[0], geometry.coordType, 3);
  decoded.positions = geometry.coordType == ElementType::float32
                          ? decodeFloats(coords, count, geometry.lattice, location)
                          : decodeIntegers(coords, count, geometry, location);
  checkInsideBox(decoded.positions, geometry, patch.box, location);

  for (const VertexRole role : vertexRoles)
    if (const std::optional<Reference>& reference = patch.vertexAttributes[role])
      decodeInto(decoded, role,
                 fetchRecords(*reference, geometry.attributeTypes[role], storedComponents(role, geometry)), count,
                 geometry);
  checkAttributes(patch, geometry);
  for (std::size_t a = 0; a < geometry.attributes.size(); ++a) {
    const AttributeDescription& attribute = geometry.attributes[a];
    decoded.namedAttributes.push_back(
        decodeAttribute(fetchRecords(patch.attributes[a][0], ElementType::float32, attribute.components), count,
                        attribute, patch.attributes[a][0].url));
  }
  return decoded;
}

} // namespace imgeo
