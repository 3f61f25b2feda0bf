#include "containers/levels/group_file.h"

#include "base/error.h"
#include "containers/compact/compact.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/payload_image.h"

#include <algorithm>
#include <span>
#include <utility>

namespace imgeo {

EncodedGroup encodeGroup(GroupMesh mesh, const GeometryDescription& geometry, const EncodeOptions& options) {
  EncodeOptions stored = options;
  if (stored.normals == NormalEncoding::derived)
    stored.normals = NormalEncoding::octahedral;
  compact::CompactPatch patch = quantisePatch(std::move(mesh.patch), geometry, stored);
  patch.segments = std::move(mesh.segments);
  for (const std::uint32_t segment : patch.segments)
    patch.segmentCount = std::max(patch.segmentCount, segment + 1);
  EncodedGroup group{{}, patch.wedgeCount(), patch.elementCount()};
  EncodedSharedFile encoded = encodeCompact(std::span(&patch, 1), options.effort);
  group.bytes = std::move(encoded.file.bytes);
  group.normalError = encoded.normalErrors.at(0);
  return group;
}

GroupTriangles readGroup(const LevelsDescription& levels, std::uint32_t number, const FetchFile& fetch) {
  const LevelGroup& stated = levels.index.groups.at(number);
  const std::string url = groupUrl(levels.url, number);
  const Bytes file = fetch(url);
  const auto require = [&](bool condition, const char* message) {
    if (!condition)
      throw Error(ErrorKind::malformed, url, message);
  };
  require(file.size() == stated.bytes, "has another size than the index of levels states");
  std::vector<compact::CompactPatch> patches = compact::decodePatches(compact::payloadOfImage(file, url), url);
  require(patches.size() == 1, "holds several patches, and groups of levels are alone in their files");
  compact::CompactPatch& patch = patches[0];
  require(patch.topology == Topology::triangles, "has no triangles");
  require(patch.positionBits == levels.index.positionBits, "the positions have other bits than the index of levels");
  require(patch.segmentCount == stated.children.size(), "has other segments than the index of levels states children");
  require(patch.wedgeCount() == stated.vertices && patch.elementCount() == stated.triangles,
          "has other vertices or triangles than the index of levels states");
  GroupTriangles group;
  group.positions = std::move(patch.positions);
  for (const std::uint32_t wedge : patch.corners)
    group.corners.push_back(patch.wedgePositions[wedge]);
  group.segments = std::move(patch.segments);
  return group;
}

} // namespace imgeo
