#include "containers/classic/classic.h"
#include "prepare/patches.h"

#include <array>

namespace imgeo {

namespace {

constexpr std::array classicNormals{NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::spherical,
                                    NormalEncoding::palette};

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
            .texCoordBits = {.min = 16, .max = 16, .defaultBits = 16},
            .colorBits = {.min = 8, .max = 8, .defaultBits = 8},
            .normals = classicNormals,
            .strips = true,
            .unindexed = true,
            .attributeBits = true,
            .maxError = true,
        },
};

} // namespace imgeo
