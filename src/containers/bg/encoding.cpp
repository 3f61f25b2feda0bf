#include "containers/bg/bg.h"

#include "containers/bg/element_types.h"
#include "containers/stored.h"
#include "prepare/patches.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>

namespace imgeo {

namespace {

constexpr std::array bgNormals{NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::spherical};

void describeBg(GeometryDescription& geometry, const PatchedMesh& mesh, const EncodeOptions& options) {
  geometry.indexType = indexTypeFor(mesh);
  chooseTypes(geometry, mesh, options);
}

EncodedPatch encodeBgPatch(const IndexedPatch& patch, const GeometryDescription& geometry,
                           const EncodeOptions& options) {
  return encodeBg(patch, geometry, options.layout);
}

std::unique_ptr<PatchReader> makeBgReader(const FetchFile& fetch) {
  return std::make_unique<SinglePatchReader>(fetch, decodeBg, findBgLattice);
}

} // namespace

constinit const EncodingRow bgEncoding{
    .encoding = Encoding::bg,
    .name = "bg",
    .container = "bg",
    .profile = "classic",
    .fileKind = "typed arrays",
    .node = {.name = "BinaryGeometry", .profile = "", .isDefaultProfile = true},
    .storage = PatchStorage::arrays,
    .location = ByteLocation{},
    .x3domVersion = "1.8.3",
    .capabilities =
        {
            .maxPositionBits = 32,
            .maxPatchVertices = maxPatchWedges,
            .texCoordBits = {.min = 8, .max = 32, .defaultBits = 16, .step = 8},
            .colorBits = {.min = 8, .max = 32, .defaultBits = 8, .step = 8},
            .normals = bgNormals,
            .strips = true,
            .unindexed = true,
            .elementTypes = true,
        },
    .resolveOptions = resolveBgOptions,
    .describe = describeBg,
    .encodeIndexed = encodeBgPatch,
    .makeReader = makeBgReader,
};

} // namespace imgeo
