#include "containers/levels/group_file.h"

#include "base/error.h"
#include "containers/compact/compact.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/payload_image.h"

#include <algorithm>
#include <span>
#include <utility>

namespace imgeo {

namespace {

/// Normals are stored: those that are derived would differ between the two sides of a group's border.
EncodeOptions withStoredNormals(EncodeOptions options) {
  if (options.normals == NormalEncoding::derived)
    options.normals = NormalEncoding::octahedral;
  return options;
}

EncodedGroup encodedGroupOf(std::span<const compact::CompactPatch> patches, int effort) {
  EncodedSharedFile encoded = encodeCompact(patches, effort);
  EncodedGroup group{std::move(encoded.file.bytes)};
  for (std::size_t i = 0; i < patches.size(); ++i) {
    group.vertices += patches[i].wedgeCount();
    if (patches[i].topology == Topology::triangles)
      group.triangles += patches[i].elementCount();
    group.normalError = std::max(group.normalError, encoded.normalErrors.at(i));
  }
  return group;
}

/// Requirements of the file of a group.
struct GroupRequirement {
  const std::string& url;
  void operator()(bool condition, const char* message) const {
    if (!condition)
      throw Error(ErrorKind::malformed, url, message);
  }
};

std::vector<compact::CompactPatch> readPatches(const LevelsDescription& levels, std::uint32_t number,
                                               const std::string& url, const FetchFile& fetch) {
  const Bytes file = fetch(url);
  const GroupRequirement require{url};
  require(file.size() == levels.index.groups.at(number).bytes, "has another size than the index of levels states");
  std::vector<compact::CompactPatch> patches = compact::decodePatches(compact::payloadOfImage(file, url), url);
  for (const compact::CompactPatch& patch : patches)
    require(patch.positionBits == levels.index.positionBits, "the positions have other bits than the index of levels");
  return patches;
}

} // namespace

EncodedGroup encodeGroup(GroupMesh mesh, const GeometryDescription& geometry, const EncodeOptions& options) {
  compact::CompactPatch patch = quantisePatch(std::move(mesh.patch), geometry, withStoredNormals(options));
  patch.segments = std::move(mesh.segments);
  for (const std::uint32_t segment : patch.segments)
    patch.segmentCount = std::max(patch.segmentCount, segment + 1);
  return encodedGroupOf(std::span(&patch, 1), options.effort);
}

EncodedGroup encodePointGroup(std::vector<Patch> segments, const GeometryDescription& geometry,
                              const EncodeOptions& options) {
  std::vector<compact::CompactPatch> patches;
  for (Patch& segment : segments)
    patches.push_back(quantisePatch(std::move(segment), geometry, withStoredNormals(options)));
  return encodedGroupOf(patches, options.effort);
}

GroupTriangles readGroup(const LevelsDescription& levels, std::uint32_t number, const FetchFile& fetch) {
  const LevelGroup& stated = levels.index.groups.at(number);
  const std::string url = groupUrl(levels.url, number);
  std::vector<compact::CompactPatch> patches = readPatches(levels, number, url, fetch);
  const GroupRequirement require{url};
  require(patches.size() == 1, "holds several patches, and groups of levels are alone in their files");
  compact::CompactPatch& patch = patches[0];
  require(patch.topology == Topology::triangles, "has no triangles");
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

std::vector<compact::CompactPatch> readPointGroup(const LevelsDescription& levels, std::uint32_t number,
                                                  const FetchFile& fetch) {
  const LevelGroup& stated = levels.index.groups.at(number);
  const std::string url = groupUrl(levels.url, number);
  std::vector<compact::CompactPatch> patches = readPatches(levels, number, url, fetch);
  const GroupRequirement require{url};
  require(patches.size() == std::max<std::size_t>(stated.children.size(), 1),
          "has other patches than the index of levels states children");
  std::size_t vertices = 0;
  for (const compact::CompactPatch& patch : patches) {
    require(patch.topology == Topology::points, "has other elements than points");
    vertices += patch.wedgeCount();
  }
  require(vertices == stated.vertices, "has other points than the index of levels states");
  return patches;
}

} // namespace imgeo
