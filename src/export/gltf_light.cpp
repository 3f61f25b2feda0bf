#include "export/gltf_light.h"

#include "export/export.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace imgeo {

namespace {

/// A rotation of -z, along which glTF lights shine, to `direction`, then a translation of the origin to `origin`.
Affine3d facing(Vec3d direction, Vec3d origin) {
  const double size = length(direction);
  if (size == 0)
    return {.translation = origin};
  const Vec3d z = direction * (-1 / size), side = cross(std::abs(z.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}, z);
  const Vec3d x = side * (1 / length(side));
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
  // Lights of glTF fall off with the square of the distance.
  const auto isSupported = [](const auto& light) {
    return light.global && light.attenuation == Vec3d{0, 0, 1} && light.radius > 0;
  };
  if (const auto* directional = std::get_if<DirectionalLight>(&content); directional && directional->global)
    return GltfLight{common("directional", *directional), facing(directional->direction, {})};
  if (const auto* point = std::get_if<PointLight>(&content); point && isSupported(*point))
    return GltfLight{local("point", *point), {.translation = point->location}};
  if (const auto* spot = std::get_if<SpotLight>(&content); spot && isSupported(*spot)) {
    Json json = local("spot", *spot);
    const double outer = std::min(spot->cutOffAngle, std::numbers::pi / 2);
    // glTF requires innerConeAngle < outerConeAngle.
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
