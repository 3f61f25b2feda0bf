#include "transcode/sample/relief_surface.h"

#include "transcode/sample/mix_bits.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace imgeo {

namespace {

/// A number from -1 to 1 for a point of the integer lattice.
double latticeNoise(std::int64_t x, std::int64_t y, std::int64_t z, int octave) {
  const std::uint64_t hash = mixBits(mixBits(mixBits(static_cast<std::uint64_t>(x)) + static_cast<std::uint64_t>(y)) +
                                     static_cast<std::uint64_t>(z) + (static_cast<std::uint64_t>(octave) << 48));
  return static_cast<double>(hash >> 11) * 0x1p-52 - 1;
}

/// Smooth noise from -1 to 1.
double noise(Vec3d at, int octave) {
  std::int64_t cell[3];
  double along[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::floor(at[axis]), t = at[axis] - low;
    cell[axis] = static_cast<std::int64_t>(low);
    along[axis] = t * t * (3 - 2 * t);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const double weight = (x ? along[0] : 1 - along[0]) * (y ? along[1] : 1 - along[1]) * (z ? along[2] : 1 - along[2]);
    sum += weight * latticeNoise(cell[0] + x, cell[1] + y, cell[2] + z, octave);
  }
  return sum;
}

} // namespace

Scattering::Scattering(std::uint64_t count, std::uint64_t seed) : count_(count), seed_(mixBits(seed + 1)) {
  while (1ull << (2 * halfBits_) < count)
    ++halfBits_;
}

std::uint64_t Scattering::round(std::uint64_t half, std::uint64_t key) const {
  return mixBits(half + seed_ * (key + 1)) & ((1ull << halfBits_) - 1);
}

std::uint64_t Scattering::once(std::uint64_t index, bool isInverse) const {
  constexpr std::uint64_t rounds = 4;
  std::uint64_t left = index >> halfBits_, right = index & ((1ull << halfBits_) - 1);
  for (std::uint64_t i = 0; i < rounds; ++i) {
    if (isInverse)
      left = std::exchange(right, left) ^ round(left, rounds - 1 - i);
    else
      right = std::exchange(left, right) ^ round(right, i);
  }
  return left << halfBits_ | right;
}

std::uint64_t Scattering::of(std::uint64_t index) const {
  do
    index = once(index, false);
  while (index >= count_);
  return index;
}

std::uint64_t Scattering::inverse(std::uint64_t index) const {
  do
    index = once(index, true);
  while (index >= count_);
  return index;
}

ReliefSurface::ReliefSurface(std::uint64_t triangles)
    : edge_(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(std::llround(std::sqrt(static_cast<double>(triangles) / 12))))) {
  while (1ull << octaves_ < edge_ / 4)
    ++octaves_;
}

/// Vertices are numbered by layers of z: the first and last are full squares, those between are their border, from
/// (0, 0) along x.
std::uint64_t ReliefSurface::numberOf(const Point& point) const {
  const auto& [x, y, z] = point;
  const std::uint64_t n = edge_, square = (n + 1) * (n + 1);
  if (z == 0)
    return y * (n + 1) + x;
  if (z == n)
    return square + (n - 1) * 4 * n + y * (n + 1) + x;
  const std::uint64_t around = y == 0 ? x : x == n ? n + y : y == n ? 3 * n - x : 4 * n - y;
  return square + (z - 1) * 4 * n + around;
}

ReliefSurface::Point ReliefSurface::pointOf(std::uint64_t number) const {
  const std::uint64_t n = edge_, square = (n + 1) * (n + 1);
  if (number < square)
    return {number % (n + 1), number / (n + 1), 0};
  number -= square;
  if (number >= (n - 1) * 4 * n) {
    number -= (n - 1) * 4 * n;
    return {number % (n + 1), number / (n + 1), n};
  }
  const std::uint64_t z = 1 + number / (4 * n), around = number % (4 * n), along = around % n;
  switch (around / n) {
  case 0:
    return {along, 0, z};
  case 1:
    return {n, along, z};
  case 2:
    return {n - along, n, z};
  default:
    return {0, n - along, z};
  }
}

ReliefSurface::Point ReliefSurface::cornerOfSide(std::uint64_t side, std::uint64_t u, std::uint64_t v) const {
  const std::size_t axis = side / 2;
  Point point{};
  point[axis] = side % 2 == 1 ? edge_ : 0;
  point[(axis + 1) % 3] = u;
  point[(axis + 2) % 3] = v;
  return point;
}

Vec3f ReliefSurface::vertex(std::uint64_t number) const {
  return positionOf(pointOf(number));
}

Vec3f ReliefSurface::vertexOfSide(std::uint64_t side, std::uint64_t u, std::uint64_t v) const {
  return positionOf(cornerOfSide(side, u, v));
}

Vec3f ReliefSurface::positionOf(const Point& point) const {
  Vec3d cube;
  for (int axis = 0; axis < 3; ++axis)
    cube[axis] = 2 * static_cast<double>(point[static_cast<std::size_t>(axis)]) / static_cast<double>(edge_) - 1;
  return surfacePoint(cube);
}

Vec3f ReliefSurface::pointInSquare(std::uint64_t number) const {
  const std::uint64_t n = edge_, hash = mixBits(number + 1);
  const auto along = [](std::uint64_t square, std::uint64_t bits) {
    return static_cast<double>(square) + static_cast<double>(bits & 0xffffff) * 0x1p-24;
  };
  return pointOfSide(number / (n * n), along(number % n, hash), along(number / n % n, hash >> 24));
}

Vec3f ReliefSurface::pointOfSide(std::uint64_t side, double u, double v) const {
  const int axis = static_cast<int>(side / 2);
  Vec3d cube;
  cube[axis] = side % 2 == 1 ? 1 : -1;
  cube[(axis + 1) % 3] = 2 * u / static_cast<double>(edge_) - 1;
  cube[(axis + 2) % 3] = 2 * v / static_cast<double>(edge_) - 1;
  return surfacePoint(cube);
}

Vec3f ReliefSurface::surfacePoint(const Vec3d& cube) const {
  // The squares become pieces of about equal area everywhere, unlike by a central projection.
  const Vec3d squares{cube.x * cube.x, cube.y * cube.y, cube.z * cube.z};
  const auto mapped = [](double along, double a, double b) { return along * std::sqrt(1 - a / 2 - b / 2 + a * b / 3); };
  const Vec3d sphere{mapped(cube.x, squares.y, squares.z), mapped(cube.y, squares.z, squares.x),
                     mapped(cube.z, squares.x, squares.y)};
  double height = 0, amplitude = 0.08, frequency = 1.5;
  for (int octave = 0; octave < octaves_; ++octave) {
    height += amplitude * noise(sphere * frequency, octave);
    amplitude *= 0.47;
    frequency *= 2;
  }
  return Vec3f(sphere * (1 + height));
}

std::array<std::uint64_t, 3> ReliefSurface::triangle(std::uint64_t number) const {
  const std::uint64_t n = edge_, square = number / 2, side = square / (n * n), u = square % n, v = square / n % n;
  return triangleOfSquare(number, side % 2 == 1, [&](std::uint64_t du, std::uint64_t dv) {
    return numberOf(cornerOfSide(side, u + du, v + dv));
  });
}

} // namespace imgeo
