#include "containers/bg/bg.h"
#include "prepare/patches.h"

#include <array>

namespace imgeo {

namespace {

constexpr std::array bgNormals{NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::spherical};

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
            .texCoordBits = {.min = 16, .max = 16, .defaultBits = 16},
            .colorBits = {.min = 8, .max = 8, .defaultBits = 8},
            .normals = bgNormals,
            .strips = true,
            .unindexed = true,
            .elementTypes = true,
        },
};

} // namespace imgeo
