#include "containers/classic/classic.h"

#include "base/error.h"
#include "base/narrow.h"
#include "containers/classic/attribute_images.h"
#include "containers/classic/layout.h"
#include "containers/grid.h"
#include "containers/image_file.h"
#include "containers/named_attributes.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"

#include <algorithm>

namespace imgeo {

namespace {

/// The texels of an image, counted through its first `columns` columns (0: all), starting at the first texel of the
/// reference.
class Texels {
public:
  Texels(const Reference& reference, const FetchFile& fetch, std::uint32_t columns, std::uint32_t minChannels)
      : image_(decodeImageFile(fetch(reference.url), reference.url)), columns_(columns != 0 ? columns : image_.width),
        first_(std::get<TexelLocation>(reference.location).firstTexel), location_(reference.url) {
    if (columns > image_.width)
      throw Error(ErrorKind::malformed, location_,
                  "the image is " + std::to_string(image_.width) + " texels wide and cannot hold " +
                      std::to_string(columns) + " columns");
    if (image_.channels < minChannels)
      throw Error(ErrorKind::malformed, location_,
                  "the image has " + std::to_string(image_.channels) + " channels where " +
                      std::to_string(minChannels) + " are needed");
  }

  const Image& image() const { return image_; }

  /// Throws Error{malformed} unless the image holds texels 0 .. count - 1. Call it before reading them.
  void require(std::uint64_t count) const {
    if (first_ + count > columns_ * image_.height)
      throw Error(ErrorKind::malformed, location_,
                  "the image of " + std::to_string(image_.width) + " x " + std::to_string(image_.height) +
                      " texels ends before its patch does");
  }

  const std::uint8_t* operator[](std::uint64_t n) const {
    const std::uint64_t texel = first_ + n;
    return &image_.pixels[(texel / columns_ * image_.width + texel % columns_) * image_.channels];
  }

private:
  Image image_;
  std::uint64_t columns_, first_;
  std::string location_;
};

constexpr std::uint32_t noTexel = UINT32_MAX;

/// The column or row of an image of `edge` texels that each byte of an index texel names: X3DOM counts in 1/256 of the
/// image, so texel t is byte round(t * 256 / edge).
std::vector<std::uint32_t> texelsByByte(std::uint32_t edge) {
  std::vector<std::uint32_t> texels(256, noTexel);
  for (std::uint32_t t = 0; t < edge; ++t)
    texels[(t * 512 + edge) / (2 * edge)] = t;
  return texels;
}

std::vector<std::uint32_t> decodeWideIndices(const PatchDescription& patch, const FetchFile& fetch) {
  const std::uint64_t count = drawnCount(patch.draws);
  const Texels texels(*patch.index, fetch, patch.implicitMeshSize.x, 3);
  texels.require(count);
  std::vector<std::uint32_t> indices(count);
  for (std::uint64_t n = 0; n < count; ++n)
    indices[n] = texels[n][0] | std::uint32_t{texels[n][1]} << 8 | std::uint32_t{texels[n][2]} << 16;
  return indices;
}

std::vector<std::uint32_t> decodeIndices(const PatchDescription& patch, const FetchFile& fetch, const Image& records,
                                         const std::string& recordsLocation) {
  if (records.width > recordColumns || records.height > recordColumns)
    throw Error(ErrorKind::malformed, recordsLocation,
                "a coordinate image that is indexed is at most 256 texels wide and 256 high");
  const std::vector<std::uint32_t> columnOf = texelsByByte(records.width), rowOf = texelsByByte(records.height);
  const std::uint64_t count = drawnCount(patch.draws);
  const Texels texels(*patch.index, fetch, patch.implicitMeshSize.x, 3);
  texels.require(count);
  std::vector<std::uint32_t> indices(count);
  for (std::uint64_t n = 0; n < count; ++n) {
    const std::uint32_t column = columnOf[texels[n][0]], row = rowOf[texels[n][1]];
    if (column == noTexel || row == noTexel)
      throw Error(ErrorKind::malformed, patch.index->url, "an index lies between two records");
    indices[n] = row * records.width + column;
  }
  return indices;
}

/// Vertices of a height map on the lattice of heightMapLattice().
void addColumnsAndRows(std::vector<Vec3u>& stored, const PatchDescription& patch) {
  const std::uint32_t columns = patch.implicitMeshSize.x;
  // 8-bit heights are spread over the 16 bits of the lattice.
  const std::uint32_t factor = patch.coord.size() == 1 ? 257 : 1;
  for (std::size_t n = 0; n < stored.size(); ++n)
    stored[n] = {patch.gridOrigin.x + static_cast<std::uint32_t>(n % columns), stored[n].x * factor,
                 patch.gridOrigin.y + static_cast<std::uint32_t>(n / columns)};
}

void addPlane(std::vector<Vec3u>& stored, const Texels& texels) {
  const int channels = std::min(static_cast<int>(texels.image().channels), 3);
  for (std::size_t n = 0; n < stored.size(); ++n)
    for (int axis = 0; axis < channels; ++axis)
      stored[n][axis] = stored[n][axis] << 8 | texels[n][axis];
}

/// Decodes normals from the two halves of an image, whose texels are counted through all columns.
std::vector<Vec3f> decodePairs(const Texels& texels, std::uint32_t count, NormalEncoding encoding) {
  const std::uint64_t half = std::uint64_t{texels.image().width} * texels.image().height / 2;
  texels.require(half + count);
  std::vector<Vec3f> normals(count);
  for (std::uint32_t n = 0; n < count; ++n)
    normals[n] = loadNormal({texels[n][0], texels[half + n][0]}, encoding, 8);
  return normals;
}

/// The number of a record that byte planes hold in a channel, most significant first.
std::uint32_t numberAt(const std::vector<Texels>& planes, std::uint64_t record, std::uint32_t channel) {
  std::uint32_t number = 0;
  for (const Texels& plane : planes)
    number = number << 8 | plane[record][channel];
  return number;
}

/// Two numbers of two bytes in a texel.
Vec2<std::uint32_t> wordPairOf(const std::uint8_t* texel) {
  return {std::uint32_t{texel[0]} << 8 | texel[2], std::uint32_t{texel[1]} << 8 | texel[3]};
}

std::vector<Vec3f> decodeNormals(const std::vector<Texels>& planes, std::uint32_t count,
                                 const GeometryDescription& geometry) {
  const std::uint32_t bits = geometry.imageBits[VertexRole::normal];
  std::vector<Vec3f> normals;
  normals.reserve(count);
  for (std::uint32_t n = 0; n < count; ++n)
    normals.push_back(isPair(geometry.normalEncoding)
                          ? loadNormal(wordPairOf(planes[0][n]), geometry.normalEncoding, bits)
                          : normalOf({numberAt(planes, n, 0), numberAt(planes, n, 1), numberAt(planes, n, 2)}, bits));
  return normals;
}

std::vector<Vec2f> decodeTexCoords(const std::vector<Texels>& planes, std::uint32_t count, const TexCoordBox& box,
                                   std::uint32_t bits) {
  const double largest = (1u << bits) - 1;
  std::vector<Vec2f> texCoords;
  texCoords.reserve(count);
  for (std::uint32_t n = 0; n < count; ++n) {
    Vec2<std::uint32_t> stored =
        bits == 8 ? Vec2<std::uint32_t>{planes[0][n][0], planes[0][n][1]} : wordPairOf(planes[0][n]);
    if (bits == 24)
      stored = {stored.x << 8 | planes[1][n][0], stored.y << 8 | planes[1][n][1]};
    texCoords.push_back(texCoordAt({stored.x / largest, stored.y / largest}, box));
  }
  return texCoords;
}

std::vector<Rgba> decodeColors(const std::vector<Texels>& planes, std::uint32_t count,
                               const GeometryDescription& geometry) {
  const double largest = (1u << geometry.imageBits[VertexRole::color]) - 1;
  const bool hasAlpha = geometry.colorComponents == 4;
  std::vector<Rgba> colors;
  colors.reserve(count);
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto channel = [&](std::uint32_t c) { return static_cast<float>(numberAt(planes, n, c) / largest); };
    colors.emplace_back(channel(0), channel(1), channel(2), hasAlpha ? channel(3) : 1);
  }
  return colors;
}

/// The channels that the first image of an attribute must have; all further ones have three, or four of colours.
std::uint32_t channelsOf(VertexRole role, const GeometryDescription& geometry) {
  if (role == VertexRole::color)
    return geometry.colorComponents;
  const bool holdsWordPairs = isTexCoord(role) ? geometry.imageBits[role] > 8 : isPair(geometry.normalEncoding);
  return holdsWordPairs ? 4 : 3;
}

/// Decodes an attribute from its byte planes, most significant first.
NamedAttribute decodeAttribute(const std::vector<Texels>& planes, std::uint32_t count,
                               const AttributeDescription& description) {
  NamedAttribute attribute{description.name, description.components, {}};
  attribute.values.reserve(std::size_t{count} * description.components);
  for (std::uint32_t n = 0; n < count; ++n)
    for (std::uint32_t c = 0; c < description.components; ++c)
      attribute.values.push_back(loadNumber(numberAt(planes, n, c), description, c));
  return attribute;
}

} // namespace

IndexedPatch decodeClassic(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch) {
  const std::uint32_t bits = geometry.lattice.bits;
  const StoredCoords stored = storedCoords(Encoding::classic, geometry.coordType, bits);
  const bool isHeightMap = geometry.grid == GridKind::heightMap;
  if (!isHeightMap && patch.coord.size() != coordBytes(Encoding::classic, bits))
    throw Error(ErrorKind::malformed, "",
                std::to_string(bits) + "-bit coordinates need " + std::to_string(coordBytes(Encoding::classic, bits)) +
                    " images and have " + std::to_string(patch.coord.size()));

  // The meaning of an index depends on the height of the record images, and the number of records may depend on the
  // indices.
  const std::uint32_t columns = patch.index ? 0 : patch.implicitMeshSize.x;
  const std::string& location = patch.coord[0].url;
  const std::uint32_t coordChannels = isHeightMap ? 1 : 3;
  // Unlike arrays, images do not state how many numbers they hold.
  if (!geometry.grid && drawnCount(patch.draws) == 0)
    throw Error(ErrorKind::malformed, location, "vertexCount is 0; nothing is drawn");
  const Texels first(patch.coord[0], fetch, columns, coordChannels);
  IndexedPatch decoded;
  decoded.draws = patch.draws;
  decoded.colorComponents = geometry.colorComponents;
  if (patch.index)
    decoded.indices = geometry.indexType == ElementType::uint32 ? decodeWideIndices(patch, fetch)
                                                                : decodeIndices(patch, fetch, first.image(), location);
  const std::uint32_t count = geometry.grid
                                  ? patch.vertexCount
                                  : recordCountOf(patch, decoded.indices, patch.index ? patch.index->url : location);
  first.require(count);

  const auto fetchRecords = [&](const Reference& reference, std::uint32_t minChannels) {
    Texels texels(reference, fetch, columns, minChannels);
    texels.require(count);
    if (texels.image().width != first.image().width || texels.image().height != first.image().height)
      throw Error(ErrorKind::malformed, reference.url, "the images of a patch differ in size");
    return texels;
  };
  decoded.positions.resize(count);
  addPlane(decoded.positions, first);
  for (std::size_t plane = 1; plane < patch.coord.size(); ++plane)
    addPlane(decoded.positions, fetchRecords(patch.coord[plane], coordChannels));
  if (isHeightMap)
    addColumnsAndRows(decoded.positions, patch);
  else
    for (Vec3u& position : decoded.positions)
      for (int axis = 0; axis < 3; ++axis)
        position[axis] = loadCoord(position[axis], stored, location);
  if (geometry.grid) {
    decoded.indices = gridTriangles(*geometry.grid, patch.implicitMeshSize, decoded.positions);
    decoded.draws = {{Primitive::triangles, narrow<std::uint32_t>(decoded.indices.size())}};
  }
  checkInsideBox(decoded.positions, geometry, patch.box, location);

  const auto fetchPlanes = [&](VertexRole role) {
    const std::uint32_t channels = channelsOf(role, geometry);
    std::vector<Texels> planes{fetchRecords(*patch.vertexAttributes[role], channels)};
    for (const Reference& plane : patch.lowBytes[role])
      planes.push_back(fetchRecords(plane, role == VertexRole::color ? channels : 3));
    return planes;
  };
  const auto decode = [&](VertexRole role, const Reference& reference) {
    switch (role) {
    case VertexRole::normal:
      decoded.normals = isPair(geometry.normalEncoding) && geometry.imageBits[role] == 8
                            ? decodePairs(Texels(reference, fetch, 0, 1), count, geometry.normalEncoding)
                            : decodeNormals(fetchPlanes(role), count, geometry);
      break;
    case VertexRole::texCoord:
    case VertexRole::texCoord1:
    case VertexRole::texCoord2:
    case VertexRole::texCoord3:
      texCoordsOf(decoded, texCoordSetOf(role)) = decodeTexCoords(
          fetchPlanes(role), count, geometry.texCoordBoxes[texCoordSetOf(role)], geometry.imageBits[role]);
      break;
    case VertexRole::color:
      decoded.colors = decodeColors(fetchPlanes(role), count, geometry);
      break;
    }
  };
  for (const VertexRole role : vertexRoles)
    if (const std::optional<Reference>& reference = patch.vertexAttributes[role]) {
      if (1 + patch.lowBytes[role].size() != imageCountOf(role, geometry.normalEncoding, geometry.imageBits[role]))
        throw Error(ErrorKind::malformed, reference->url,
                    std::string("there are ") + std::to_string(1 + patch.lowBytes[role].size()) + " images of " +
                        nameOf(role) + ", which do not hold " + std::to_string(geometry.imageBits[role]) + " bits");
      decode(role, *reference);
    }
  checkAttributes(patch, geometry);
  for (std::size_t a = 0; a < geometry.attributes.size(); ++a) {
    std::vector<Texels> planes;
    for (const Reference& plane : patch.attributes[a])
      planes.push_back(fetchRecords(plane, channelsOf(geometry.attributes[a])));
    decoded.namedAttributes.push_back(decodeAttribute(planes, count, geometry.attributes[a]));
  }
  return decoded;
}

} // namespace imgeo
