#include "import/readable.h"

#include <cstdlib>
#include <fmt/format.h>

namespace imgeo {

namespace {

Vec3d readableVector(const Vec3d& v, int digits) {
  return {readable(v.x, digits), readable(v.y, digits), readable(v.z, digits)};
}

Rotation readableTurn(const Rotation& rotation, int digits) {
  return {readableVector(rotation.axis, digits), readable(rotation.angle, digits)};
}

} // namespace

double readable(double value, int digits) {
  const auto single = static_cast<float>(value);
  const std::string text = single == value ? fmt::format("{}", single) : fmt::format("{:.{}g}", value, digits);
  return std::strtod(text.c_str(), nullptr) + 0.0; // no -0
}

Transform readable(const Transform& transform) {
  constexpr int ofPlaces = 12, ofTurns = 8;
  return {readableVector(transform.translation, ofPlaces), readableTurn(transform.rotation, ofTurns),
          readableVector(transform.scale, ofTurns), readableTurn(transform.scaleOrientation, ofTurns),
          readableVector(transform.center, ofPlaces)};
}

} // namespace imgeo
