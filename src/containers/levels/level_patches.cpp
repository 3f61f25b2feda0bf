#include "containers/levels/level_patches.h"

#include "base/error.h"

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

} // namespace

void readLevels(GeometryDescription& geometry, const FetchFile& fetch) {
  LevelsDescription& levels = geometry.levels.value();
  levels.index = readLevelIndex(levels.url, fetch);
  if (levels.index.positionBits != geometry.lattice.bits)
    throw Error(ErrorKind::malformed, levels.url, "the positions have other bits than the node states");
  choosePatchesOfLevel(geometry, 0);
}

void choosePatchesOfLevel(GeometryDescription& geometry, std::uint32_t level) {
  const LevelsDescription& levels = geometry.levels.value();
  geometry.patches.clear();
  for (std::uint32_t number = 0; number < levels.index.groups.size(); ++number)
    if (levels.index.groups[number].level == level)
      geometry.patches.push_back(patchOf(levels, number));
}

std::vector<std::pair<std::string, Role>> filesOfLevels(const LevelsDescription& levels) {
  std::vector<std::pair<std::string, Role>> files;
  for (std::size_t page = 0; page < levels.index.pageCount(); ++page)
    files.emplace_back(levelPageUrl(levels.url, page), Role::levels);
  for (std::uint32_t number = 0; number < levels.index.groups.size(); ++number)
    files.emplace_back(groupUrl(levels.url, number), levels.index.groups[number].level == 0 ? Role::patch : Role::base);
  return files;
}

} // namespace imgeo
