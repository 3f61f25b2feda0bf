#include "import/text/rounded_decimal.h"

#include <cstdlib>
#include <fmt/format.h>

namespace imgeo {

namespace {

Vec3d roundedVector(const Vec3d& v, int digits) {
  return {rounded(v.x, digits), rounded(v.y, digits), rounded(v.z, digits)};
}

Rotation roundedRotation(const Rotation& rotation, int digits) {
  return {roundedVector(rotation.axis, digits), rounded(rotation.angle, digits)};
}

} // namespace

double rounded(double value, int digits) {
  const auto single = static_cast<float>(value);
  const std::string text = single == value ? fmt::format("{}", single) : fmt::format("{:.{}g}", value, digits);
  return std::strtod(text.c_str(), nullptr) + 0.0; // no -0
}

Transform rounded(const Transform& transform) {
  constexpr int lengthDigits = 12, ratioDigits = 8;
  return {roundedVector(transform.translation, lengthDigits), roundedRotation(transform.rotation, ratioDigits),
          roundedVector(transform.scale, ratioDigits), roundedRotation(transform.scaleOrientation, ratioDigits),
          roundedVector(transform.center, lengthDigits)};
}

} // namespace imgeo
