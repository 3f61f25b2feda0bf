#include "containers/compact/compact.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>

namespace imgeo {

namespace {

/// `rgb` is convert's default and stands for octahedral.
constexpr std::array compactNormals{NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::derived};

void describeCompact(GeometryDescription& geometry, const PatchedMesh&, const EncodeOptions&) {
  geometry.normalEncoding = NormalEncoding::rgb; // the files state the encoding, the node does not
  // Texture coordinates are predicted from the shapes of triangles: one step on both axes.
  for (TexCoordBox& box : geometry.texCoordBoxes)
    box.size.x = box.size.y = std::max(box.size.x, box.size.y);
}

std::unique_ptr<PatchReader> makeCompactReader(const FetchFile& fetch) {
  return std::make_unique<CompactReader>(fetch);
}

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
            .maxPositionBits = compact::maxPositionBits,
            .maxPatchVertices = compact::maxCount,
            .maxNamedAttributes = compact::maxAttributes - 3, // beside normals, texture coordinates and colours
            .texCoordBits = {.min = 1, .max = 16, .defaultBits = 12},
            .colorBits = {.min = 1, .max = 8, .defaultBits = 8},
            .normals = compactNormals,
            .attributeBits = true,
            .maxError = true,
            .base = true,
            .levels = true,
        },
    .resolveOptions = resolveCompactOptions,
    .describe = describeCompact,
    .sharing = &compactSharing,
    .makeReader = makeCompactReader,
};

} // namespace imgeo
