#pragma once
// A generated surface of any number of triangles: a sphere with a fractal relief, computed vertex by vertex.

#include "base/vec.h"

#include <array>
#include <cstdint>

namespace imgeo {

/// A bijection of 0 .. count - 1 that scatters neighbours: a Feistel network, repeated until the result is in range.
class Scattering {
public:
  /// `count` is 1 .. 2^40.
  Scattering(std::uint64_t count, std::uint64_t seed);

  std::uint64_t of(std::uint64_t index) const;
  std::uint64_t inverse(std::uint64_t index) const;

private:
  std::uint64_t round(std::uint64_t half, std::uint64_t key) const;
  std::uint64_t once(std::uint64_t index, bool isInverse) const;

  std::uint64_t count_, seed_;
  int halfBits_ = 1;
};

/// The corners of triangle `number`, of which each square of a cube's side has two: `at(du, dv)` says which vertex is
/// at a corner of the square. Counterclockwise seen from outside, where sides with odd numbers are the far ones.
template <typename At> std::array<std::uint64_t, 3> triangleOfSquare(std::uint64_t number, bool isFar, const At& at) {
  const std::array<std::uint64_t, 3> corners =
      number % 2 == 1 ? std::array{at(0, 0), at(1, 1), at(0, 1)} : std::array{at(0, 0), at(1, 0), at(1, 1)};
  return isFar ? corners : std::array{corners[0], corners[2], corners[1]};
}

/// A closed surface: the six sides of a cube of n x n squares, mapped to the unit sphere and moved along its normals by
/// up to about 0.15. Every vertex has one number. Positions do not depend on the machine.
class ReliefSurface {
public:
  /// The surface with about `triangles` of them, 12 .. 10^10.
  explicit ReliefSurface(std::uint64_t triangles);

  std::uint64_t vertexCount() const { return 6 * edge_ * edge_ + 2; }
  std::uint64_t triangleCount() const { return 12 * edge_ * edge_; }

  Vec3f vertex(std::uint64_t number) const;
  /// A point of the surface within each square, at a position that has no pattern, 0 .. squareCount() - 1.
  Vec3f pointInSquare(std::uint64_t number) const;
  std::uint64_t squareCount() const { return 6 * edge_ * edge_; }
  /// The vertices of a triangle, counterclockwise seen from outside.
  std::array<std::uint64_t, 3> triangle(std::uint64_t number) const;

  /// A corner of the squares of side 0 .. 5; u and v are 0 .. edge(). Corners of several sides are the same there.
  Vec3f vertexOfSide(std::uint64_t side, std::uint64_t u, std::uint64_t v) const;
  /// A point of side 0 .. 5; u and v are 0 .. edge(), and need not be whole.
  Vec3f pointOfSide(std::uint64_t side, double u, double v) const;
  std::uint64_t edge() const { return edge_; } ///< squares along an edge of the cube

private:
  using Point = std::array<std::uint64_t, 3>; ///< 0 .. edge_ in each direction, on the cube's surface

  Point cornerOfSide(std::uint64_t side, std::uint64_t u, std::uint64_t v) const;
  Vec3f positionOf(const Point& point) const;
  /// The point of the surface over one of the cube -1 .. 1.
  Vec3f surfacePoint(const Vec3d& cube) const;
  std::uint64_t numberOf(const Point& point) const;
  Point pointOf(std::uint64_t number) const;

  std::uint64_t edge_; ///< squares along an edge of the cube
  int octaves_ = 1;
};

} // namespace imgeo
