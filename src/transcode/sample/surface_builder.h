#pragma once
// Builds meshes of parametric surfaces, for generated scenes.

#include "scene/mesh.h"

#include <cmath>
#include <numbers>

namespace imgeo {

class SurfaceBuilder {
public:
  Mesh mesh;

  struct Point {
    Vec3d position, normal;
  };

  /// Adds a grid of columns x rows quads of the surface `at(u, v)`, u and v in 0..1. The front side is that of the
  /// cross product of the derivatives by u and by v.
  template <typename At> void addGrid(std::uint32_t columns, std::uint32_t rows, const At& at) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t row = 0; row <= rows; ++row)
      for (std::uint32_t column = 0; column <= columns; ++column) {
        const double u = static_cast<double>(column) / columns, v = static_cast<double>(row) / rows;
        const Point point = at(u, v);
        mesh.wedgePositions.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(Vec3f(point.position));
        mesh.normals.push_back(Vec3f(point.normal * (1 / length(point.normal))));
        mesh.texCoords.push_back({static_cast<float>(u), static_cast<float>(v)});
      }
    for (std::uint32_t row = 0; row < rows; ++row)
      for (std::uint32_t column = 0; column < columns; ++column) {
        const std::uint32_t a = first + row * (columns + 1) + column, b = a + columns + 1;
        mesh.corners.insert(mesh.corners.end(), {a, a + 1, b + 1, a, b + 1, b});
      }
  }

  void addBox(Vec3d min, Vec3d max) {
    const Vec3d center = (min + max) * 0.5, half = (max - min) * 0.5;
    const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        const Vec3d n = axes[axis] * side, a = axes[(axis + 1) % 3] * side, b = axes[(axis + 2) % 3];
        addGrid(1, 1, [&](double u, double v) {
          const Vec3d unit = n + a * (2 * u - 1) + b * (2 * v - 1);
          return Point{center + Vec3d{unit.x * half.x, unit.y * half.y, unit.z * half.z}, n};
        });
      }
  }

  /// Adds a cylinder without caps. `segments`: quads around it; `rings`: quads along it; `flutes`: grooves along it.
  void addBar(Vec3d from, Vec3d to, double radius, std::uint32_t segments, std::uint32_t rings = 1, int flutes = 0) {
    const Vec3d along = (to - from) * (1 / length(to - from));
    const Vec3d aside = cross(along, std::abs(along.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0});
    const Vec3d a = aside * (1 / length(aside)), b = cross(along, a);
    addGrid(segments, rings, [&](double u, double v) {
      const double angle = 2 * std::numbers::pi * u;
      const Vec3d out = a * std::cos(angle) + b * std::sin(angle);
      const double depth = flutes > 0 ? 1 - 0.06 * std::abs(std::sin(flutes * angle / 2)) : 1;
      return Point{from + (to - from) * v + out * (radius * depth), out};
    });
  }

  /// Adds a cushion: a superellipsoid (Barr 1981) with the exponent 1/4.
  void addCushion(Vec3d center, Vec3d half, std::uint32_t segments) {
    const auto power = [](double value, double exponent) {
      return std::copysign(std::pow(std::abs(value), exponent), value);
    };
    addGrid(segments, segments / 2, [&](double u, double v) {
      const double phi = 2 * std::numbers::pi * u, theta = std::numbers::pi * (v - 0.5);
      const auto pointAt = [&](double e) {
        return Vec3d{power(std::cos(theta), e) * power(std::cos(phi), e), power(std::sin(theta), e),
                     -power(std::cos(theta), e) * power(std::sin(phi), e)};
      };
      const Vec3d unit = pointAt(0.25), normal = pointAt(1.75);
      return Point{center + Vec3d{unit.x * half.x, unit.y * half.y, unit.z * half.z},
                   {normal.x / half.x, normal.y / half.y, normal.z / half.z}};
    });
  }
};

} // namespace imgeo
