#include "documents/equal_geometries.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

/// The files of a geometry, one a line: geometries with other files differ.
std::string filesOf(const GeometryDescription& geometry) {
  std::string files;
  const auto add = [&](const Reference& reference) {
    files += reference.url;
    files += '\n';
  };
  for (const PatchDescription& patch : geometry.patches)
    visitReferences(patch, [&](Role, const Reference& reference) { add(reference); });
  if (geometry.base)
    add(*geometry.base);
  if (geometry.levels)
    files += geometry.levels->url;
  return files;
}

} // namespace

void shareEqualGeometries(SceneDocument& document) {
  std::vector<GeometryDescription> kept;
  std::vector<std::size_t> newIndex;
  std::map<std::string, std::vector<std::size_t>> byFiles; ///< indices into `kept`
  for (GeometryDescription& geometry : document.geometries) {
    std::vector<std::size_t>& candidates = byFiles[filesOf(geometry)];
    const auto equal =
        std::ranges::find_if(candidates, [&](std::size_t candidate) { return kept[candidate] == geometry; });
    if (equal != candidates.end()) {
      newIndex.push_back(*equal);
      continue;
    }
    candidates.push_back(kept.size());
    newIndex.push_back(kept.size());
    kept.push_back(std::move(geometry));
  }
  document.geometries = std::move(kept);
  for (const std::size_t node : shapeNodes(document.graph)) {
    Shape& shape = std::get<Shape>(document.graph.nodes[node].content);
    shape.mesh = newIndex[shape.mesh];
  }
}

} // namespace imgeo
