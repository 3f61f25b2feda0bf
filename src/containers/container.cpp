#include "containers/container.h"

#include "base/error.h"
#include "containers/bg/bg.h"
#include "containers/bg/element_types.h"
#include "containers/classic/classic.h"
#include "containers/compact/compact.h"
#include "containers/limits.h"
#include "containers/named_attributes.h"

#include <algorithm>
#include <cassert>

namespace imgeo {

namespace {

/// The box of all texture coordinates, as its least corner and its extent. X3DOM
/// knows no such box: integers hold 0..1 there, and floats the rest.
void spreadTexCoords(GeometryDescription& geometry, const PatchedMesh& mesh, Target target) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  Vec2f min{infinite, infinite}, max{-infinite, -infinite};
  for (const Patch& patch : mesh.patches)
    for (const Vec2f& texCoord : patch.texCoords) {
      min = {std::min(min.x, texCoord.x), std::min(min.y, texCoord.y)};
      max = {std::max(max.x, texCoord.x), std::max(max.y, texCoord.y)};
    }
  if (!(min.x <= max.x))
    return;
  if (target == Target::x3dom) {
    if (min.x >= 0 && min.y >= 0 && max.x <= 1 && max.y <= 1)
      return;
    if (geometry.encoding == Encoding::classic)
      throw Error(ErrorKind::unsupported, "",
                  "X3DOM's images hold texture coordinates of 0..1 alone and these go beyond; container bg "
                  "holds them");
    geometry.texCoordType = ElementType::float32;
    return;
  }
  geometry.texCoordMin = min;
  geometry.texCoordSize = {max.x - min.x, max.y - min.y};
  // Compact predicts them from the shapes of triangles: one step on both axes.
  if (geometry.encoding == Encoding::compact)
    geometry.texCoordSize.x = geometry.texCoordSize.y = std::max(geometry.texCoordSize.x, geometry.texCoordSize.y);
}

/// 16 bits wherever they name all vertices of every patch.
ElementType indexTypeOf(const PatchedMesh& mesh) {
  const bool isShort = std::ranges::all_of(
      mesh.patches, [](const Patch& patch) { return patch.wedgeCount() <= maxShortIndexedVertices; });
  return isShort ? ElementType::uint16 : ElementType::uint32;
}

} // namespace

GeometryDescription describe(const PatchedMesh& mesh, const EncodeOptions& options) {
  GeometryDescription geometry;
  geometry.encoding = options.encoding;
  geometry.lattice = mesh.lattice;
  geometry.box = mesh.box;
  spreadTexCoords(geometry, mesh, options.target);
  for (const Patch& patch : mesh.patches)
    geometry.colorComponents = std::max(geometry.colorComponents, patch.colorComponents);
  // X3DOM takes the number of colour components of a page's first ImageGeometry for all.
  if (options.target == Target::x3dom && options.encoding == Encoding::classic)
    geometry.colorComponents = 4;
  geometry.normalEncoding = options.normals;
  geometry.attributes = describeAttributes(mesh, options.encoding, options.attributeBits / 8);
  if (options.encoding == Encoding::bg)
    chooseTypes(geometry, mesh, options);
  if (options.encoding == Encoding::compact) { // its files say
    geometry.normalEncoding = NormalEncoding::rgb;
    return geometry;
  }
  geometry.indexType = indexTypeOf(mesh);
  assert(geometry.indexType == ElementType::uint16 || options.target == Target::web ||
         options.encoding == Encoding::bg);
  return geometry;
}

EncodedPatch encodePatch(const IndexedPatch& patch, const GeometryDescription& geometry, const EncodeOptions& options) {
  assert(geometry.encoding != Encoding::compact);
  return geometry.encoding == Encoding::classic ? encodeClassic(patch, geometry, options.effort, options.target)
                                                : encodeBg(patch, geometry, options.layout);
}

ContainerReader::ContainerReader(FetchFile fetch)
    : fetch_(std::move(fetch)), compact_(std::make_unique<CompactFiles>(fetch_)) {}

ContainerReader::~ContainerReader() = default;

IndexedPatch ContainerReader::decode(const PatchDescription& patch, const GeometryDescription& geometry) const {
  if (geometry.encoding == Encoding::bg)
    return decodeBg(patch, geometry, fetch_);
  return geometry.encoding == Encoding::classic ? decodeClassic(patch, geometry, fetch_)
                                                : compact_->decode(patch, geometry);
}

BaseMesh ContainerReader::decodeBase(const GeometryDescription& geometry) const {
  return compact_->decodeBase(geometry);
}

IndexedPatch decodePatch(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch) {
  return ContainerReader(fetch).decode(patch, geometry);
}

IndexedPatch decodePatch(const EncodedPatch& encoded, const GeometryDescription& geometry) {
  std::vector<std::string> urls;
  for (std::size_t i = 0; i < encoded.files.size(); ++i)
    urls.push_back("file " + std::to_string(i));
  return decodePatch(describeWithUrls(encoded, urls), geometry, [&](const std::string& url) {
    return encoded.files[static_cast<std::size_t>(std::ranges::find(urls, url) - urls.begin())].bytes;
  });
}

StoredPrecision ContainerReader::precisionOf(const GeometryDescription& geometry) const {
  if (geometry.encoding == Encoding::compact)
    return geometry.patches.empty() ? StoredPrecision{} : compact_->precisionOf(geometry.patches[0]);
  const bool isBg = geometry.encoding == Encoding::bg;
  const auto bits = [&](auto reference, ElementType type, std::uint32_t inImages) {
    const bool isThere = std::ranges::any_of(
        geometry.patches, [&](const PatchDescription& patch) { return (patch.*reference).has_value(); });
    return !isThere ? 0 : isBg ? 8 * byteSizeOf(type) : inImages;
  };
  return {bits(&PatchDescription::normal, geometry.normalType, 8),
          bits(&PatchDescription::texCoord, geometry.texCoordType, 16),
          bits(&PatchDescription::color, geometry.colorType, 8), geometry.normalEncoding};
}

} // namespace imgeo
