#include "containers/container.h"

#include "base/error.h"
#include "containers/bg/bg.h"
#include "containers/classic/classic.h"
#include "containers/limits.h"
#include "containers/normals.h"

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
    if (geometry.container == Container::sig)
      throw Error(ErrorKind::unsupported, "",
                  "X3DOM's images hold texture coordinates of 0..1 alone and these go beyond; container bg "
                  "holds them");
    geometry.texCoordType = ElementType::float32;
    return;
  }
  geometry.texCoordMin = min;
  geometry.texCoordSize = {max.x - min.x, max.y - min.y};
}

ElementType unsignedType(std::uint32_t bytes) {
  return bytes == 1 ? ElementType::uint8 : bytes == 2 ? ElementType::uint16 : ElementType::uint32;
}

/// 16 bits wherever they name all vertices of every patch.
ElementType indexTypeOf(const PatchedMesh& mesh, const EncodeOptions& options) {
  const bool isShort = std::ranges::all_of(
      mesh.patches, [](const Patch& patch) { return patch.wedgeCount() <= maxShortIndexedVertices; });
  assert(isShort || options.target == Target::web || options.container == Container::bg);
  return isShort ? ElementType::uint16 : ElementType::uint32;
}

ElementType normalTypeOf(const EncodeOptions& options) {
  assert(options.normals != NormalEncoding::palette);
  assert(options.normalBits == 8 || options.normals != NormalEncoding::spherical);
  assert(options.normalBits == 8 || options.normalBits == 16 || options.normalBits == 32);
  if (isPair(options.normals))
    return unsignedType(options.normalBits / 8);
  return options.normalBits == 8    ? ElementType::int8
         : options.normalBits == 16 ? ElementType::int16
                                    : ElementType::float32;
}

} // namespace

GeometryDescription describe(const PatchedMesh& mesh, const EncodeOptions& options) {
  GeometryDescription geometry;
  geometry.container = options.container;
  geometry.lattice = mesh.lattice;
  geometry.box = mesh.box;
  spreadTexCoords(geometry, mesh, options.target);
  for (const Patch& patch : mesh.patches)
    geometry.colorComponents = std::max(geometry.colorComponents, patch.colorComponents);
  // X3DOM takes the number of colour components of a page's first ImageGeometry for all.
  if (options.target == Target::x3dom && options.container == Container::sig)
    geometry.colorComponents = 4;
  if (options.container == Container::bg) {
    assert(options.target == Target::web || mesh.lattice.bits <= 16);
    geometry.coordType = unsignedType(coordBytes(Container::bg, mesh.lattice.bits));
    geometry.normalType = normalTypeOf(options);
    assert(!isPair(options.normals) || options.normalBits == 16 || byteSizeOf(geometry.coordType) == 2);
  } else {
    assert(options.normalBits == 8);
  }
  geometry.indexType = indexTypeOf(mesh, options);
  geometry.normalEncoding = options.normals;
  return geometry;
}

EncodedPatch encodePatch(const IndexedPatch& patch, const GeometryDescription& geometry,
                         const EncodeOptions& options) {
  return geometry.container == Container::sig ? encodeClassic(patch, geometry, options.effort, options.target)
                                              : encodeBg(patch, geometry);
}

IndexedPatch decodePatch(const PatchDescription& patch, const GeometryDescription& geometry,
                         const FetchFile& fetch) {
  return geometry.container == Container::sig ? decodeClassic(patch, geometry, fetch)
                                              : decodeBg(patch, geometry, fetch);
}

} // namespace imgeo
