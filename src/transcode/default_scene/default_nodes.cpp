#include "transcode/default_scene/default_nodes.h"

#include "import/warnings.h"
#include "transcode/default_scene/default_lighting.h"
#include "transcode/default_scene/default_viewpoint.h"
#include "transcode/default_scene/world_box.h"

#include <algorithm>
#include <fmt/format.h>
#include <ranges>
#include <type_traits>
#include <utility>

namespace imgeo {

namespace {

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

bool hasShiningLight(const SceneGraph& graph) {
  return std::ranges::any_of(nodesInOrder(graph),
                             [&](std::size_t node) { return isShiningLight(graph.nodes[node].content); });
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

struct NamedView {
  const char* description;
  StartView view;
};

constexpr NamedView namedViews[] = {{"Front", StartView::front}, {"Left", StartView::left},
                                    {"Back", StartView::back},   {"Right", StartView::right},
                                    {"Top", StartView::top},     {"Bottom", StartView::bottom}};

/// The default viewpoints in the order of the document, whose first one is bound: the view that is asked for and, with
/// `all`, those from all other sides except from below.
std::vector<Viewpoint> defaultViewpoints(const Box3d& box, StartView view, const ViewSamples& samples, bool all) {
  std::vector<Viewpoint> viewpoints;
  const auto add = [&](const char* description, Vec3d direction) {
    viewpoints.push_back(withShortNumbers(viewpointFrom(direction, box, samples.outline)));
    viewpoints.back().description = description;
  };
  if (view == StartView::automatic)
    add("Start", bestDirection(samples.surface));
  else
    add(std::ranges::find(namedViews, view, &NamedView::view)->description, directionOf(view));
  for (const NamedView& named : namedViews)
    if (all && named.view != view && named.view != StartView::bottom)
      add(named.description, directionOf(named.view));
  return viewpoints;
}

} // namespace

bool hasViewpoint(const SceneGraph& graph) {
  return std::ranges::any_of(nodesInOrder(graph), [&](std::size_t node) {
    const NodeContent& content = graph.nodes[node].content;
    return std::holds_alternative<Viewpoint>(content) || std::holds_alternative<OrthoViewpoint>(content);
  });
}

void addDefaultNodes(SceneDocument& document, StartView view, const ViewSamples& samples,
                     std::vector<std::string>& warnings) {
  SceneGraph& graph = document.graph;
  const WorldBox world = worldBoxOf(document);
  if (world.undrawableShapes > 0)
    warnings.push_back(fmt::format("{} scaled by more than 10^15 or less than 10^-15, or moved as far: what "
                                   "stands there cannot be drawn.",
                                   counted(world.undrawableShapes, "shape is", "shapes are")));
  Box3d box = world.box.empty() ? Box3d{{}, {}} : world.box;
  if (!samples.moving.empty())
    for (const Vec3d& corner : {samples.moving.min, samples.moving.max})
      box.add(corner);
  setCentersOfRotation(graph, box.center());
  // A source with lights is lit by them alone: a headlight would wash out what its author has lit.
  graph.headlight = !hasShiningLight(graph);
  if (graph.headlight)
    addLights(graph);
  const bool isOwn = hasViewpoint(graph);
  if (!isOwn || view != StartView::automatic) {
    std::vector<Viewpoint> viewpoints = defaultViewpoints(box, view, samples, !isOwn);
    for (Viewpoint& viewpoint : viewpoints | std::views::reverse)
      addFirst(graph, std::move(viewpoint));
  }
  if (!graph.background)
    graph.background = lightGray;
}

} // namespace imgeo
