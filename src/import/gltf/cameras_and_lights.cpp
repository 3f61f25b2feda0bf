#include "import/gltf/cameras_and_lights.h"

#include "import/gltf/node_content.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace imgeo::gltf {

namespace {

/// The radius of X3D lights that stand for glTF lights of unlimited range.
constexpr double unlimitedRadius = 1e6;

/// X3D's field of view is that of the shorter side, glTF's the vertical one.
double fieldOfViewOf(const Value& perspective) {
  const double vertical = std::clamp(perspective["yfov"].real(0.7854), 1e-3, std::numbers::pi - 1e-3);
  const double aspect = perspective["aspectRatio"].real(1);
  return aspect > 0 && aspect < 1 ? 2 * std::atan(std::tan(vertical / 2) * aspect) : vertical;
}

} // namespace

std::optional<Node> cameraOf(const Document& document, const Value& node) {
  const std::optional<std::size_t> index = node.index("camera", document.array("cameras"));
  if (!index)
    return {};
  const Value camera = document.array("cameras")[*index];
  const std::string description = camera["name"].text(node["name"].text());
  if (camera.has("orthographic")) {
    OrthoViewpoint viewpoint;
    viewpoint.description = description;
    viewpoint.position = {};
    const double x = camera["orthographic"]["xmag"].real(1), y = camera["orthographic"]["ymag"].real(1);
    viewpoint.min = {-x, -y};
    viewpoint.max = {x, y};
    return Node{"", viewpoint, {}, extrasOf(camera)};
  }
  Viewpoint viewpoint;
  viewpoint.description = description;
  viewpoint.position = {};
  viewpoint.fieldOfView = fieldOfViewOf(camera["perspective"]);
  return Node{"", viewpoint, {}, extrasOf(camera)};
}

std::optional<Node> lightOf(const Document& document, const Value& node, double scale, Damage& damage) {
  const Value lights = document.root()["extensions"]["KHR_lights_punctual"]["lights"];
  const std::optional<std::size_t> index = node["extensions"]["KHR_lights_punctual"].index("light", lights);
  if (!index)
    return {};
  const Value light = lights[*index];
  const Vec3f color = light["color"].vec3f({1, 1, 1});
  const auto intensity = static_cast<float>(light["intensity"].real(1));
  const double range = light["range"].real(0), unit = scale > 0 && std::isfinite(scale) ? scale : 1,
               radius = (range > 0 ? range : unlimitedRadius) / unit;
  const Vec3d bySquare{0, 0, unit * unit};
  const std::string type = light["type"].text();
  NodeContent content;
  if (type == "directional") {
    content = DirectionalLight{{0, 0, -1}, color, intensity, true};
  } else if (type == "point") {
    content = PointLight{{}, bySquare, radius, color, intensity, true};
  } else if (type == "spot") {
    const double inner = light["spot"]["innerConeAngle"].real(0),
                 outer = light["spot"]["outerConeAngle"].real(std::numbers::pi / 4);
    content = SpotLight{{}, {0, 0, -1}, inner, outer, bySquare, radius, color, intensity, true};
  } else {
    damage.attempt([&] { light["type"].fail(ErrorKind::unsupported, "is no light that X3D has"); });
    return {};
  }
  return Node{light["name"].text(), content, {}, extrasOf(light)};
}

} // namespace imgeo::gltf
