#include "containers/levels/level_patches.h"

#include "base/error.h"
#include "containers/levels/group_file.h"

namespace imgeo {

namespace {

PatchDescription patchOf(const LevelsDescription& levels, std::uint32_t number) {
  const LevelGroup& group = levels.index.groups[number];
  PatchDescription patch;
  patch.vertexCount = group.vertices;
  patch.draws = {{Primitive::triangles, 3 * group.triangles}};
  patch.data = Reference{groupUrl(levels.url, number), PatchLocation{0}};
  return patch;
}

/// The patches of a group of points. Where there are several, the files alone know how many points each has.
void addPointPatches(const LevelsDescription& levels, std::uint32_t number, const FetchFile& fetch,
                     std::vector<PatchDescription>& patches) {
  const LevelGroup& group = levels.index.groups[number];
  const Reference file{groupUrl(levels.url, number), PatchLocation{0}};
  if (group.level == 0) {
    PatchDescription& patch = patches.emplace_back();
    patch.vertexCount = group.vertices;
    patch.draws = {{Primitive::points, group.vertices}};
    patch.data = file;
    return;
  }
  const std::vector<compact::CompactPatch> segments = readPointGroup(levels, number, fetch);
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    PatchDescription& patch = patches.emplace_back();
    patch.vertexCount = static_cast<std::uint32_t>(segments[i].wedgeCount());
    patch.draws = {{Primitive::points, patch.vertexCount}};
    patch.data = Reference{file.url, PatchLocation{i}};
  }
}

} // namespace

void readLevels(GeometryDescription& geometry, const FetchFile& fetch) {
  LevelsDescription& levels = geometry.levels.value();
  levels.index = readLevelIndex(levels.url, fetch);
  if (levels.index.positionBits != geometry.lattice.bits)
    throw Error(ErrorKind::malformed, levels.url, "the positions have other bits than the node states");
  if (levels.index.hasPoints != (levels.topology == Topology::points))
    throw Error(ErrorKind::malformed, levels.url,
                levels.index.hasPoints ? "has points, and the node states triangles"
                                       : "has triangles, and the node states points");
  if (levels.index.hasChips != (levels.chipSet > 0))
    throw Error(ErrorKind::malformed, levels.url, "groups have images, and the node states none, or the reverse");
  choosePatchesOfLevel(geometry, 0, fetch);
}

void choosePatchesOfLevel(GeometryDescription& geometry, std::uint32_t level, const FetchFile& fetch) {
  const LevelsDescription& levels = geometry.levels.value();
  geometry.patches.clear();
  for (std::uint32_t number = 0; number < levels.index.groups.size(); ++number) {
    if (levels.index.groups[number].level != level)
      continue;
    if (levels.index.hasPoints)
      addPointPatches(levels, number, fetch, geometry.patches);
    else
      geometry.patches.push_back(patchOf(levels, number));
  }
}

std::vector<std::pair<std::string, Role>> filesOfLevels(const LevelsDescription& levels) {
  std::vector<std::pair<std::string, Role>> files;
  for (std::size_t page = 0; page < levels.index.pageCount(); ++page)
    files.emplace_back(levelPageUrl(levels.url, page), Role::levels);
  for (std::uint32_t number = 0; number < levels.index.groups.size(); ++number)
    files.emplace_back(groupUrl(levels.url, number), levels.index.groups[number].level == 0 ? Role::patch : Role::base);
  for (std::uint32_t number = 0; levels.index.hasChips && number < levels.index.groups.size(); ++number)
    files.emplace_back(chipUrl(levels.url, number), Role::chips);
  return files;
}

} // namespace imgeo
