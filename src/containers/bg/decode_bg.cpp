#include "containers/bg/bg.h"

#include "base/error.h"
#include "containers/stored.h"

namespace imgeo {

namespace {

/// The records of one attribute: `components` elements each, `stride` bytes apart.
class Records {
public:
  Records(const Reference& reference, const FetchFile& fetch, ElementType type, std::uint32_t components)
      : bytes_(fetch(reference.url)), place_(reference.url), type_(type), first_(reference.first),
        stride_(reference.stride != 0 ? reference.stride : components * byteSizeOf(type)) {
    if (stride_ < components * byteSizeOf(type))
      throw Error(ErrorKind::malformed, place_,
                  "a stride of " + std::to_string(stride_) + " bytes is less than a record of " +
                      std::to_string(components) + " " + nameOf(type));
  }

  /// To be called before records 0 .. count - 1 are read.
  void require(std::uint64_t count) const {
    if (first_ > bytes_.size() || (bytes_.size() - first_) / stride_ < count)
      throw Error(ErrorKind::truncated, place_,
                  std::to_string(bytes_.size()) + " bytes are too few for " + std::to_string(count) +
                      " records of " + std::to_string(stride_) + " bytes from byte " + std::to_string(first_));
  }

  std::uint32_t unsignedAt(std::uint64_t record, std::uint32_t component) const {
    const std::uint8_t* at = this->at(record, component);
    switch (byteSizeOf(type_)) {
    case 1: return *at;
    case 2: return loadLittle<std::uint16_t>(at);
    default: return loadLittle<std::uint32_t>(at);
    }
  }

  double realAt(std::uint64_t record, std::uint32_t component) const {
    const std::uint8_t* at = this->at(record, component);
    switch (type_) {
    case ElementType::int8: return static_cast<std::int8_t>(*at);
    case ElementType::int16: return loadLittle<std::int16_t>(at);
    case ElementType::int32: return loadLittle<std::int32_t>(at);
    case ElementType::float32: return loadLittle<float>(at);
    default: return unsignedAt(record, component);
    }
  }

private:
  const std::uint8_t* at(std::uint64_t record, std::uint32_t component) const {
    return &bytes_[first_ + record * stride_ + component * byteSizeOf(type_)];
  }

  Bytes bytes_;
  std::string place_;
  ElementType type_;
  std::uint64_t first_, stride_;
};

bool isUnsigned(ElementType type) {
  return type == ElementType::uint8 || type == ElementType::uint16 || type == ElementType::uint32;
}

void requireType(bool supported, const std::string& place, const char* attribute, ElementType type) {
  if (!supported)
    throw Error(ErrorKind::unsupported, place, std::string(attribute) + " of type " + nameOf(type));
}

std::vector<std::uint32_t> decodeIndices(const PatchDescription& patch, ElementType type, const FetchFile& fetch) {
  requireType(isUnsigned(type), patch.index->url, "indices", type);
  const std::uint64_t count = drawnCount(patch.draws);
  const Records records(*patch.index, fetch, type, 1);
  records.require(count);
  std::vector<std::uint32_t> indices(count);
  for (std::uint64_t n = 0; n < count; ++n) indices[n] = records.unsignedAt(n, 0);
  return indices;
}

} // namespace

IndexedPatch decodeBg(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch) {
  if (patch.coord.size() != 1)
    throw Error(ErrorKind::malformed, "", "a BinaryGeometry patch has one file of coordinates");
  const std::string& place = patch.coord[0].url;
  requireType(isUnsigned(geometry.coordType), place, "coordinates", geometry.coordType);
  if (byteSizeOf(geometry.coordType) != coordBytes(Container::bg, geometry.lattice.bits))
    throw Error(ErrorKind::malformed, place,
                std::string(nameOf(geometry.coordType)) + " is no type for coordinates of " +
                    std::to_string(geometry.lattice.bits) + " bits");

  IndexedPatch decoded;
  decoded.draws = patch.draws;
  decoded.colorComponents = geometry.colorComponents;
  if (patch.index) decoded.indices = decodeIndices(patch, geometry.indexType, fetch);
  const std::uint32_t count = recordCountOf(patch, decoded.indices, patch.index ? patch.index->url : place);
  const auto fetchRecords = [&](const Reference& reference, ElementType type, std::uint32_t components) {
    Records records(reference, fetch, type, components);
    records.require(count);
    return records;
  };

  const Records coords = fetchRecords(patch.coord[0], geometry.coordType, 3);
  const std::uint32_t shift = coordShift(Container::bg, geometry.lattice.bits);
  decoded.positions.resize(count);
  for (std::uint32_t n = 0; n < count; ++n)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      decoded.positions[n][static_cast<int>(axis)] = loadCoord(coords.unsignedAt(n, axis), shift, place);
  checkInsideBox(decoded.positions, geometry.lattice, patch.box, place);

  if (patch.normal) {
    const ElementType type = geometry.normalType;
    requireType(!isUnsigned(type), patch.normal->url, "normals", type);
    const Records records = fetchRecords(*patch.normal, type, 3);
    for (std::uint32_t n = 0; n < count; ++n)
      decoded.normals.push_back(unitNormal({records.realAt(n, 0), records.realAt(n, 1), records.realAt(n, 2)}));
  }
  if (patch.texCoord) {
    requireType(geometry.texCoordType == ElementType::uint16, patch.texCoord->url, "texture coordinates", geometry.texCoordType);
    const Records records = fetchRecords(*patch.texCoord, geometry.texCoordType, 2);
    const auto load = [&](std::uint32_t n, std::uint32_t axis, float min, float size) {
      return loadTexCoord(static_cast<std::uint16_t>(records.unsignedAt(n, axis)), min, size);
    };
    for (std::uint32_t n = 0; n < count; ++n)
      decoded.texCoords.push_back({load(n, 0, geometry.texCoordMin.x, geometry.texCoordSize.x),
                                   load(n, 1, geometry.texCoordMin.y, geometry.texCoordSize.y)});
  }
  if (patch.color) {
    requireType(geometry.colorType == ElementType::uint8, patch.color->url, "colours", geometry.colorType);
    const Records records = fetchRecords(*patch.color, geometry.colorType, geometry.colorComponents);
    const auto byte = [&](std::uint32_t n, std::uint32_t c) { return static_cast<std::uint8_t>(records.unsignedAt(n, c)); };
    for (std::uint32_t n = 0; n < count; ++n)
      decoded.colors.push_back({byte(n, 0), byte(n, 1), byte(n, 2), geometry.colorComponents == 4 ? byte(n, 3) : std::uint8_t{255}});
  }
  return decoded;
}

} // namespace imgeo
