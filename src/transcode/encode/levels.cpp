#include "transcode/encode/levels.h"

#include "base/narrow.h"
#include "containers/encodings.h"
#include "containers/levels/group_file.h"
#include "containers/levels/level_patches.h"
#include "containers/normals.h"
#include "containers/stored_coords.h"
#include "prepare/degenerate_elements.h"
#include "scene/skin.h"
#include "transcode/site/site_files.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace imgeo {

namespace {

/// Meshes of more triangles get levels where convert chooses: more than one view needs, and than sixteen patches hold.
constexpr std::size_t maxTrianglesWithoutLevels = 2'000'000;

/// The fields of the node, from all attributes of the mesh, which it leaves as they are.
GeometryDescription describeMesh(Mesh& mesh, const std::vector<Vec3u>& points, const Lattice& lattice,
                                 const EncodeOptions& options) {
  PatchedMesh whole;
  whole.lattice = lattice;
  Patch& patch = whole.patches.emplace_back();
  static_cast<VertexAttributes&>(patch) = std::move(static_cast<VertexAttributes&>(mesh));
  patch.positions = points;
  whole.box = boxOf(patch, lattice);
  GeometryDescription geometry = describe(whole, options);
  static_cast<VertexAttributes&>(mesh) = std::move(static_cast<VertexAttributes&>(patch));
  return geometry;
}

/// The encoded groups of all levels.
class EncodedLevels {
public:
  EncodedLevels(const GeometryDescription& geometry, const EncodeOptions& options, const ElementsDone& done)
      : geometry_(geometry), options_(options), done_(done) {}

  GroupSink sink() {
    return {[this](std::uint32_t, std::size_t groupCount) { byLevel_.emplace_back(groupCount); },
            [this](std::uint32_t level, std::size_t group, GroupMesh mesh) {
              std::uint32_t childCount = 0;
              for (const std::uint32_t segment : mesh.segments)
                childCount = std::max(childCount, segment + 1);
              const std::size_t elementCount = mesh.patch.elementCount();
              byLevel_[level][group] = encodeGroup(std::move(mesh), childCount, geometry_, options_);
              if (level == 0)
                done_(elementCount);
            }};
  }

  /// The groups in the order of the index: from the highest level down.
  std::vector<EncodedGroup> take() {
    std::vector<EncodedGroup> all;
    for (auto level = byLevel_.rbegin(); level != byLevel_.rend(); ++level)
      std::ranges::move(*level, std::back_inserter(all));
    return all;
  }

private:
  const GeometryDescription& geometry_;
  const EncodeOptions& options_;
  const ElementsDone& done_;
  std::vector<std::vector<EncodedGroup>> byLevel_;
};

LevelIndex indexOf(const Levels& levels, const std::vector<EncodedGroup>& encoded, std::uint32_t bits) {
  LevelIndex index;
  index.positionBits = bits;
  index.rootCount = levels.rootCount;
  std::vector<GroupBounds> bounds;
  for (std::size_t number = 0; number < encoded.size(); ++number) {
    const LeveledGroup& group = levels.groups[number];
    LevelGroup row;
    row.level = static_cast<std::uint8_t>(group.level);
    row.vertices = narrow<std::uint32_t>(encoded[number].vertices);
    row.triangles = narrow<std::uint32_t>(encoded[number].triangles);
    row.bytes = narrow<std::uint32_t>(encoded[number].bytes.size());
    row.children = group.children;
    index.groups.push_back(std::move(row));
    bounds.push_back({group.center, group.radius, group.error});
  }
  setBounds(index, bounds);
  return index;
}

/// Writes all files into a folder that has the name of their contents. Returns the url of the index.
std::string writeFiles(const LevelIndex& index, const std::vector<EncodedGroup>& groups, ContentFiles& files) {
  std::vector<FolderFile> all;
  const std::vector<Bytes> pages = writeLevelIndex(index);
  for (std::size_t page = 0; page < pages.size(); ++page)
    all.push_back({levelPageUrl(levelIndexName, page), pages[page]});
  for (std::uint32_t number = 0; number < groups.size(); ++number)
    all.push_back({groupFileName(number), groups[number].bytes});
  return files.writeFolder(all) + "/" + levelIndexName;
}

} // namespace

bool getsLevels(const Mesh& mesh, const Lattice& lattice, const ConvertOptions& options) {
  if (options.levels == LevelChoice::never || !rowOf(*options.encoding).capabilities.levels)
    return false;
  if (mesh.topology != Topology::triangles || mesh.corners.empty() || options.primitives != Primitives::triangles ||
      isDeformed(mesh) || lattice.bits > maxLevelBits)
    return false;
  const std::size_t maxTriangles =
      options.levels == LevelChoice::always ? options.groupTriangles : maxTrianglesWithoutLevels;
  return mesh.elementCount() > maxTriangles;
}

EncodedMesh encodeLevels(Mesh mesh, const Lattice& lattice, const ConvertOptions& options, ContentFiles& files,
                         const ElementsDone& done) {
  EncodedMesh result;
  const EncodeOptions encoding = encodeOptionsFrom(options);
  const std::vector<Vec3u> points = quantise(mesh.positions, lattice);
  result.collapsed.of(mesh.topology) = countCollapsedElements(mesh, points, lattice.bits);
  result.geometry = describeMesh(mesh, points, lattice, encoding);
  noteAttributes(result, mesh, options);
  result.positionError = positionErrorBound(result.geometry);

  EncodedLevels encodedLevels(result.geometry, encoding, done);
  const Levels levels =
      buildLevels(std::move(mesh), points, {.groupTriangles = options.groupTriangles}, encodedLevels.sink());
  const std::vector<EncodedGroup> groups = encodedLevels.take();
  LevelsDescription description{{}, indexOf(levels, groups, lattice.bits)};
  description.url = writeFiles(description.index, groups, files);
  if (description.index.rootCount == 1 && description.index.levelCount() > 1)
    result.geometry.base = Reference{groupUrl(description.url, 0), PatchLocation{0}};
  result.geometry.levels = std::move(description);
  choosePatchesOfLevel(result.geometry, 0);
  double normalError = 0;
  for (std::size_t number = 0; number < groups.size(); ++number) {
    normalError = std::max(normalError, groups[number].normalError);
    if (levels.groups[number].level > 0)
      continue;
    result.vertices += groups[number].vertices;
    result.elements.triangles += groups[number].triangles;
  }
  if (result.hasNormals)
    result.normalErrorDegrees = std::max(normalErrorBound(result.geometry), normalError) * (180 / std::numbers::pi);
  return result;
}

} // namespace imgeo
