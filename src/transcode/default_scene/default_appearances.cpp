#include "transcode/default_scene/default_appearances.h"

#include "scene/point_material.h"
#include "transcode/default_scene/default_lighting.h"

#include <map>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

bool drawsSurface(const GeometryDescription& geometry) {
  return topologyOf(geometry.patches.front().draws.front().primitive) == Topology::triangles;
}

/// Makes the appearances that shapes lack, each once.
class DefaultAppearances {
public:
  explicit DefaultAppearances(SceneGraph& graph) : graph_(graph) {}

  /// Index of the appearance that a shape is drawn with.
  std::size_t appearanceFor(const Shape& shape, bool isLit) {
    if (shape.appearance && isLit)
      return *shape.appearance;
    const auto [made, isNew] = made_.try_emplace({shape.appearance, isLit}, graph_.appearances.size());
    if (isNew) {
      Appearance appearance;
      appearance.material = stone;
      if (shape.appearance)
        appearance = graph_.appearances[*shape.appearance];
      if (!isLit)
        appearance.material = pointMaterialOf(appearance.material);
      graph_.appearances.push_back(std::move(appearance));
    }
    return made->second;
  }

private:
  SceneGraph& graph_;
  std::map<std::pair<std::optional<std::size_t>, bool>, std::size_t> made_; ///< by source appearance and isLit
};

} // namespace

void assignDefaultAppearances(SceneDocument& document, const std::vector<bool>& hasNormals) {
  DefaultAppearances defaults(document.graph);
  for (const std::size_t node : shapeNodes(document.graph)) {
    Shape& shape = std::get<Shape>(document.graph.nodes[node].content);
    const bool isLit = hasNormals[shape.mesh] || drawsSurface(document.geometries[shape.mesh]);
    shape.appearance = defaults.appearanceFor(shape, isLit);
  }
}

} // namespace imgeo
