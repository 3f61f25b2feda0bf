#include "transcode/default_scene/default_nodes.h"

#include "import/warnings.h"
#include "transcode/default_scene/default_viewpoint.h"
#include "transcode/default_scene/world_box.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace imgeo {

namespace {

/// From above and to the left of the viewer, warmer than the headlight, so that relief has a bright side and a dark
/// one.
constexpr DirectionalLight keyLight{{-0.45, -0.8, -0.4}, {1.0f, 0.96f, 0.9f}, 0.4f};

/// From the opposite side, cooler, with ambient light: walls and ceilings of rooms are not black, wherever the viewer
/// looks.
constexpr DirectionalLight fillLight{{0.5, 0.7, 0.5}, {0.9f, 0.95f, 1.0f}, 0.3f};

constexpr Background lightGray{{0.93f, 0.94f, 0.95f}};

/// The fill light's ambientIntensity: a fifth of a colour's brightness on the screen. Material multiplies ambient light
/// by its default ambientIntensity 0.2; in a PhysicalMaterial's linear numbers 0.04 is as bright.
float ambientIntensityFor(const SceneGraph& graph) {
  const bool isPhysical = std::ranges::any_of(graph.appearances, [](const Appearance& appearance) {
    return std::holds_alternative<PhysicalMaterial>(appearance.material);
  });
  return isPhysical ? 0.04f : 1.0f;
}

struct ExistingNodes {
  bool viewpoint = false, light = false;
};

ExistingNodes existingNodes(const SceneGraph& graph) {
  ExistingNodes existing;
  for (const std::size_t index : nodesInOrder(graph)) {
    const NodeContent& content = graph.nodes[index].content;
    existing.viewpoint |= std::holds_alternative<Viewpoint>(content) || std::holds_alternative<OrthoViewpoint>(content);
    existing.light |= std::holds_alternative<DirectionalLight>(content) ||
                      std::holds_alternative<PointLight>(content) || std::holds_alternative<SpotLight>(content);
  }
  return existing;
}

void addFirst(SceneGraph& graph, NodeContent content) {
  graph.roots.insert(graph.roots.begin(), addNode(graph, {"", std::move(content), {}, ""}));
}

void addLights(SceneGraph& graph) {
  DirectionalLight fill = fillLight;
  fill.ambientIntensity = ambientIntensityFor(graph);
  addFirst(graph, fill);
  addFirst(graph, keyLight);
}

} // namespace

void addDefaultNodes(SceneDocument& document, std::vector<std::string>& warnings) {
  SceneGraph& graph = document.graph;
  const ExistingNodes existing = existingNodes(graph);
  const WorldBox world = worldBoxOf(document);
  if (world.undrawableShapes > 0)
    warnings.push_back(fmt::format("{} scaled by more than 10^15 or less than 10^-15, or moved as far: what "
                                   "stands there cannot be drawn.",
                                   counted(world.undrawableShapes, "shape is", "shapes are")));
  const Box3d box = world.box.empty() ? Box3d{{}, {}} : world.box;
  setCentersOfRotation(graph, box.center());
  if (!existing.light)
    addLights(graph);
  if (!existing.viewpoint)
    addFirst(graph, viewpointFraming(box));
  if (!graph.background)
    graph.background = lightGray;
}

} // namespace imgeo
