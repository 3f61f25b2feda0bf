#include "export/gltf_light.h"

#include "export/export.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace imgeo {

namespace {

/// A map that turns -z to a direction and moves the origin: glTF lights shine along -z of their node.
Affine3d facing(Vec3d direction, Vec3d origin) {
  const double size = length(direction);
  if (size == 0)
    return {.translation = origin};
  const Vec3d z = direction * (-1 / size), aside = cross(std::abs(z.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}, z);
  const Vec3d x = aside * (1 / length(aside));
  return {x, cross(z, x), z, origin};
}

} // namespace

std::optional<GltfLight> gltfLight(const NodeContent& content) {
  const auto common = [](const char* type, const auto& light) {
    return Json{
        {"type", type}, {"color", {light.color.x, light.color.y, light.color.z}}, {"intensity", light.intensity}};
  };
  const auto local = [&](const char* type, const auto& light) {
    Json json = common(type, light);
    json["range"] = light.radius;
    return json;
  };
  const auto isSupported = [](const auto& light) {
    return light.global && light.attenuation == Vec3d{0, 0, 1} && light.radius > 0;
  };
  if (const auto* sun = std::get_if<DirectionalLight>(&content); sun && sun->global)
    return GltfLight{common("directional", *sun), facing(sun->direction, {})};
  if (const auto* lamp = std::get_if<PointLight>(&content); lamp && isSupported(*lamp))
    return GltfLight{local("point", *lamp), {.translation = lamp->location}};
  if (const auto* spot = std::get_if<SpotLight>(&content); spot && isSupported(*spot)) {
    Json json = local("spot", *spot);
    const double outer = std::min(spot->cutOffAngle, std::numbers::pi / 2);
    // The inner angle has to be the smaller one.
    json["spot"] = {{"innerConeAngle", std::min(spot->beamWidth, outer * 0.999)}, {"outerConeAngle", outer}};
    return GltfLight{std::move(json), facing(spot->direction, spot->location)};
  }
  return {};
}

std::size_t lightsLeftOut(const SceneGraph& graph) {
  const auto isLeftOut = [&](std::size_t node) {
    const NodeContent& content = graph.nodes[node].content;
    const bool isLight = std::holds_alternative<DirectionalLight>(content) ||
                         std::holds_alternative<PointLight>(content) || std::holds_alternative<SpotLight>(content);
    return isLight && !gltfLight(content);
  };
  return static_cast<std::size_t>(std::ranges::count_if(nodesInOrder(graph), isLeftOut));
}

} // namespace imgeo
