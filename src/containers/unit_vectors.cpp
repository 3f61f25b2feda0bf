#include "containers/unit_vectors.h"

#include <cassert>
#include <numbers>

namespace imgeo {

namespace {

using std::numbers::pi;

double signNotZero(double value) {
  return value < 0 ? -1.0 : 1.0;
}

Vec3d normalised(Vec3d v) {
  const double norm = length(v);
  return norm > 0 ? v * (1 / norm) : Vec3d{0, 0, 1};
}

/// Unfolds the surface of the octahedron to the square [-1, 1]^2.
Vec2<double> unfold(Vec3d v) {
  const double sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  const double x = v.x / sum, y = v.y / sum;
  if (v.z >= 0)
    return {x, y};
  return {(1 - std::abs(y)) * signNotZero(x), (1 - std::abs(x)) * signNotZero(y)};
}

Vec3d fold(Vec2<double> p) {
  Vec3d v{p.x, p.y, 1 - std::abs(p.x) - std::abs(p.y)};
  if (v.z < 0) {
    v.x = (1 - std::abs(p.y)) * signNotZero(p.x);
    v.y = (1 - std::abs(p.x)) * signNotZero(p.y);
  }
  return normalised(v);
}

/// The coordinate of a grid point, -1 .. 1.
double gridCoordinate(std::uint32_t encoded, std::uint32_t last) {
  return 2.0 * std::min(encoded, last) / last - 1.0;
}

} // namespace

Vec2<std::uint32_t> octahedralFromUnit(Vec3f unit, std::uint32_t bits) {
  assert(bits >= 2 && bits <= 16);
  const std::uint32_t last = (1u << bits) - 2;
  const Vec3d direction = normalised(Vec3d(unit));
  const Vec2<double> p = unfold(direction);
  const auto below = [last](double value) {
    const double scaled = std::floor((value * 0.5 + 0.5) * last);
    return static_cast<std::uint32_t>(std::clamp(scaled, 0.0, static_cast<double>(last)));
  };
  const Vec2<std::uint32_t> corner{below(p.x), below(p.y)};
  Vec2<std::uint32_t> best = corner;
  double bestCosine = -2;
  for (std::uint32_t dy = 0; dy < 2; ++dy) {
    for (std::uint32_t dx = 0; dx < 2; ++dx) {
      const Vec2<std::uint32_t> tried{std::min(corner.x + dx, last), std::min(corner.y + dy, last)};
      const double cosine = dot(fold({gridCoordinate(tried.x, last), gridCoordinate(tried.y, last)}), direction);
      if (cosine > bestCosine) {
        bestCosine = cosine;
        best = tried;
      }
    }
  }
  return best;
}

Vec3f unitFromOctahedral(Vec2<std::uint32_t> encoded, std::uint32_t bits) {
  assert(bits >= 2 && bits <= 16);
  const std::uint32_t last = (1u << bits) - 2;
  return Vec3f(fold({gridCoordinate(encoded.x, last), gridCoordinate(encoded.y, last)}));
}

Vec2<std::uint32_t> sphericalFromUnit(Vec3f unit, std::uint32_t bits) {
  assert(bits >= 1 && bits <= 16);
  const double last = (1u << bits) - 1;
  const Vec3d v = normalised(Vec3d(unit));
  const double theta = std::acos(std::clamp(v.z, -1.0, 1.0));
  const double phi = std::atan2(v.y, v.x);
  return {static_cast<std::uint32_t>(std::lround(theta / pi * last)),
          static_cast<std::uint32_t>(std::lround((phi / (2 * pi) + 0.5) * last))};
}

Vec3f unitFromSpherical(Vec2<std::uint32_t> encoded, std::uint32_t bits) {
  assert(bits >= 1 && bits <= 16);
  const std::uint32_t last = (1u << bits) - 1;
  const double theta = pi * std::min(encoded.x, last) / last;
  const double phi = pi * (2.0 * std::min(encoded.y, last) / last - 1);
  return Vec3f(Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
}

double octahedralErrorBound(std::uint32_t bits) {
  // On a face of the octahedron the grid is a lattice of equilateral triangles of edge sqrt(2) cell, whose points are
  // at most edge / sqrt(3) from a corner; seen from the origin, 1 / sqrt(3) away at the face's centre, that is sqrt(2)
  // cell.
  const double cell = 2.0 / ((1u << bits) - 2);
  return std::sqrt(2.0) * cell * 1.001 + 1e-6;
}

double sphericalErrorBound(std::uint32_t bits) {
  const double last = (1u << bits) - 1;
  const double halfTheta = pi / last / 2, halfPhi = 2 * pi / last / 2;
  return std::hypot(halfTheta, halfPhi) * 1.0001 + 1e-6;
}

double componentErrorBound(double step) {
  // A box of half-edge step / 2 around the tip of the unit vector, seen from the origin.
  return std::asin(std::min(1.0, std::sqrt(3.0) * step / 2)) + 1e-6;
}

double angleBetween(Vec3f a, Vec3f b) {
  const Vec3d da = Vec3d(a), db = Vec3d(b);
  return std::atan2(length(cross(da, db)), dot(da, db));
}

} // namespace imgeo
