#include "import/vrml1/lights_and_cameras.h"

#include "import/text/rounded_decimal.h"
#include "import/vrml1/appearances.h"
#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo::vrml1 {

namespace {

/// Lights of VRML 1.0 reach any distance.
constexpr const char* unlimitedRadius = "1e+09";

Vec3d withShortDecimals(const Vec3d& v) {
  return {rounded(v.x, 8), rounded(v.y, 8), rounded(v.z, 8)};
}

/// VRML 1.0's light falls by the cosine to the power of 128 dropOffRate; X3D's falls from beamWidth to cutOffAngle.
/// Both have half their intensity at the same angle.
void setCone(pugi::xml_node light, const Node& node) {
  double cutOff = std::clamp(node.real("cutOffAngle", 0.785398), 0.001, 1.570796), beam = cutOff;
  if (const double exponent = 128 * std::clamp(node.real("dropOffRate", 0), 0.0, 1.0); exponent > 0) {
    const double half = std::acos(std::pow(0.5, 1 / exponent));
    if (half < cutOff) {
      beam = std::max(2 * half - cutOff, 0.0);
      cutOff = std::min(cutOff, 2 * half);
    }
  }
  x3d::set(light, "beamWidth", fmt::format("{}", rounded(beam, 6)));
  x3d::set(light, "cutOffAngle", fmt::format("{}", rounded(cutOff, 6)));
}

} // namespace

void addLight(pugi::xml_node group, const Node& node, const Affine3d& matrix, x3d::VrmlElements& elements) {
  pugi::xml_node light = elements.add(group, node.type, node.where);
  if (!node.name.empty())
    x3d::set(light, "DEF", elements.define(node.name, node.type));
  if (node.field("intensity"))
    x3d::set(light, "intensity", fmt::format("{}", node.real("intensity", 1)));
  if (node.field("color"))
    x3d::set(light, "color", textOf(node.vector("color", {1, 1, 1})));
  if (!node.is("PointLight"))
    x3d::set(light, "direction", textOf(withShortDecimals(matrix.direction(node.vector("direction", {0, 0, -1})))));
  if (!node.is("DirectionalLight")) {
    x3d::set(light, "location", textOf(withShortDecimals(matrix.point(node.vector("location", {0, 0, 1})))));
    x3d::set(light, "radius", unlimitedRadius);
  }
  if (node.is("SpotLight"))
    setCone(light, node);
  x3d::set(light, "global", "false");
}

void addCamera(pugi::xml_node parent, const Node& node, x3d::VrmlElements& elements) {
  const bool isOrthographic = node.is("OrthographicCamera");
  pugi::xml_node camera = elements.add(parent, isOrthographic ? "OrthoViewpoint" : "Viewpoint", node.where);
  if (!node.name.empty()) {
    x3d::set(camera, "DEF", elements.define(node.name, camera.name()));
    x3d::set(camera, "description", node.name);
  }
  const Vec3d position = node.vector("position", {0, 0, 1});
  x3d::set(camera, "position", textOf(position));
  const std::vector<double>& turn = node.numbers("orientation");
  const Rotation rotation = turn.size() < 4 ? Rotation{} : Rotation{{turn[0], turn[1], turn[2]}, turn[3]};
  if (rotation.angle != 0)
    x3d::set(camera, "orientation", fmt::format("{} {}", textOf(rotation.axis), rotation.angle));
  if (node.field("focalDistance")) // the default is no statement of the author
    x3d::set(
        camera, "centerOfRotation",
        textOf(withShortDecimals(position + affineOf(rotation).direction({0, 0, -node.real("focalDistance", 5)}))));
  if (isOrthographic) {
    const double half = node.real("height", 2) / 2;
    x3d::set(camera, "fieldOfView", fmt::format("{0} {0} {1} {1}", -half, half));
  } else {
    x3d::set(camera, "fieldOfView", fmt::format("{}", node.real("heightAngle", 0.785398)));
  }
}

} // namespace imgeo::vrml1
