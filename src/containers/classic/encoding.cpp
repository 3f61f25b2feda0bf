#include "containers/classic/classic.h"

#include "base/error.h"
#include "containers/stored.h"
#include "prepare/patches.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>

namespace imgeo {

namespace {

constexpr std::array classicNormals{NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::spherical,
                                    NormalEncoding::palette};

void describeClassic(GeometryDescription& geometry, const PatchedMesh& mesh, const EncodeOptions& options) {
  geometry.indexType = indexTypeFor(mesh);
  geometry.imageBits[VertexRole::normal] = options.normalBits;
  for (const VertexRole set : texCoordRoles)
    geometry.imageBits[set] = options.texCoordBits;
  geometry.imageBits[VertexRole::color] = options.colorBits;
  if (options.target != Target::x3dom)
    return;
  if (!hasUnitTexCoords(mesh))
    throw Error(ErrorKind::unsupported, "",
                "X3DOM's images hold texture coordinates of 0..1 alone and these go beyond; container bg holds them");
  // X3DOM takes the number of colour components of a page's first ImageGeometry for all.
  geometry.colorComponents = 4;
  assert(geometry.indexType == ElementType::uint16);
}

EncodedPatch encodeClassicPatch(const IndexedPatch& patch, const GeometryDescription& geometry,
                                const EncodeOptions& options) {
  return encodeClassic(patch, geometry, options);
}

std::unique_ptr<PatchReader> makeClassicReader(const FetchFile& fetch) {
  return std::make_unique<SinglePatchReader>(fetch, decodeClassic);
}

} // namespace

constinit const EncodingRow classicEncoding{
    .encoding = Encoding::classic,
    .name = "classic",
    .container = "sig",
    .profile = "classic",
    .fileKind = "PNG images",
    .node = {.name = "ImageGeometry", .profile = "classic", .isDefaultProfile = true},
    .storage = PatchStorage::bytePlanes,
    .location = TexelLocation{},
    .x3domVersion = "1.7.2",
    .isAutomatic = true,
    .capabilities =
        {
            .maxPositionBits = 32,
            .maxPatchVertices = maxPatchWedges,
            .texCoordBits = {.min = 8, .max = 24, .defaultBits = 16, .step = 8},
            .colorBits = {.min = 8, .max = 24, .defaultBits = 8, .step = 8},
            .normals = classicNormals,
            .strips = true,
            .unindexed = true,
            .attributeBits = true,
            .maxError = true,
            .webp = true,
        },
    .resolveOptions = resolveClassicOptions,
    .describe = describeClassic,
    .encodeIndexed = encodeClassicPatch,
    .makeReader = makeClassicReader,
};

} // namespace imgeo
