#include "transcode/default_scene/default_nodes.h"

#include "import/warnings.h"
#include "transcode/default_scene/default_viewpoint.h"
#include "transcode/default_scene/world_box.h"

#include <algorithm>
#include <fmt/format.h>
#include <type_traits>
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

/// Whether a light adds anything to the picture: exporters write lights of intensity 0, too.
bool shines(const auto& light) {
  return light.intensity > 0 && (light.color.x > 0 || light.color.y > 0 || light.color.z > 0);
}

bool isShiningLight(const NodeContent& content) {
  const auto is = [&]<typename Light>(std::type_identity<Light>) {
    const Light* light = std::get_if<Light>(&content);
    return light && shines(*light);
  };
  return is(std::type_identity<DirectionalLight>{}) || is(std::type_identity<PointLight>{}) ||
         is(std::type_identity<SpotLight>{});
}

struct ExistingNodes {
  bool viewpoint = false, shiningLight = false;
};

ExistingNodes existingNodes(const SceneGraph& graph) {
  ExistingNodes existing;
  for (const std::size_t index : nodesInOrder(graph)) {
    const NodeContent& content = graph.nodes[index].content;
    existing.viewpoint |= std::holds_alternative<Viewpoint>(content) || std::holds_alternative<OrthoViewpoint>(content);
    existing.shiningLight |= isShiningLight(content);
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
  // A source with lights is lit by them alone: a headlight would wash out what its author has lit.
  graph.headlight = !existing.shiningLight;
  if (!existing.shiningLight)
    addLights(graph);
  if (!existing.viewpoint)
    addFirst(graph, viewpointFraming(box));
  if (!graph.background)
    graph.background = lightGray;
}

} // namespace imgeo
