#include "containers/compact/compact.h"

#include <array>

namespace imgeo {

namespace {

/// `rgb` is convert's default and stands for octahedral.
constexpr std::array compactNormals{NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::derived};

} // namespace

constinit const EncodingRow compactEncoding{
    .encoding = Encoding::compact,
    .name = "compact",
    .container = "sig",
    .profile = "compact",
    .fileKind = "PNG images",
    .node = {.name = "ImageGeometry", .profile = "compact", .isDefaultProfile = false},
    .storage = PatchStorage::packed,
    .location = PatchLocation{},
    .hasMeasuredNormalError = true,
    .isAutomatic = true,
    .capabilities =
        {
            .maxPositionBits = 30,
            .maxPatchVertices = compact::maxPatchCount,
            .maxNamedAttributes = compact::maxAttributes - 3, // beside normals, texture coordinates and colours
            .texCoordBits = {.min = 1, .max = 16, .defaultBits = 12},
            .colorBits = {.min = 1, .max = 8, .defaultBits = 8},
            .normals = compactNormals,
            .attributeBits = true,
            .maxError = true,
            .base = true,
            .sharedFiles = true,
        },
};

} // namespace imgeo
