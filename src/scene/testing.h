#pragma once
// Meshes for tests: closed, open, seamed, broken and random ones. Header-only and for tests alone. The same arguments
// give the same bits on every machine: the C++ standard defines the numbers of std::mt19937, and no distribution of the
// standard library is used.

#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace imgeo::testing {

/// Random numbers that are the same with every standard library.
class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_()); }
  /// 0 .. bound - 1; bound is at least 1.
  std::uint32_t below(std::size_t bound) { return static_cast<std::uint32_t>(bits() % bound); }
  /// low .. high
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(bits() >> 8) / static_cast<float>(0xffffff);
  }
  /// True in one of `count` cases.
  bool oneIn(std::uint32_t count) { return below(count) == 0; }
  Vec3f point() {
    const float x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
    return {x, y, z};
  }
  Vec3f direction() {
    Vec3d d(point());
    while (dot(d, d) < 0.01)
      d = Vec3d(point());
    return Vec3f(d * (1 / length(d)));
  }
  Rgba8 color() {
    const std::uint32_t b = bits();
    return {std::uint8_t(b), std::uint8_t(b >> 8), std::uint8_t(b >> 16), 255};
  }

private:
  std::mt19937 engine_;
};

/// Adds one wedge for each position without one.
inline void addPlainWedges(Mesh& mesh) {
  for (std::size_t i = mesh.wedgePositions.size(); i < mesh.positions.size(); ++i)
    mesh.wedgePositions.push_back(static_cast<std::uint32_t>(i));
}

inline void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.corners.insert(mesh.corners.end(), {a, b, c});
}

/// The unit sphere: closed, with normals; 2 + (rings - 1) * segments vertices, 2 * (rings - 1) * segments triangles.
/// `rings` is at least 2, `segments` at least 3.
inline Mesh sphere(std::uint32_t rings, std::uint32_t segments) {
  assert(rings >= 2 && segments >= 3);
  Mesh mesh;
  mesh.name = "sphere";
  mesh.positions.push_back({0, 1, 0});
  for (std::uint32_t ring = 1; ring < rings; ++ring)
    for (std::uint32_t segment = 0; segment < segments; ++segment) {
      const double theta = std::numbers::pi * ring / rings, phi = 2 * std::numbers::pi * segment / segments;
      mesh.positions.push_back(
          Vec3f(Vec3d{std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)}));
    }
  mesh.positions.push_back({0, -1, 0});
  addPlainWedges(mesh);
  mesh.normals = mesh.positions;

  const auto at = [&](std::uint32_t ring, std::uint32_t segment) {
    return 1 + (ring - 1) * segments + segment % segments;
  };
  const std::uint32_t south = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (std::uint32_t s = 0; s < segments; ++s)
    addTriangle(mesh, 0, at(1, s), at(1, s + 1));
  for (std::uint32_t r = 1; r + 1 < rings; ++r)
    for (std::uint32_t s = 0; s < segments; ++s) {
      addTriangle(mesh, at(r, s), at(r + 1, s), at(r + 1, s + 1));
      addTriangle(mesh, at(r, s), at(r + 1, s + 1), at(r, s + 1));
    }
  for (std::uint32_t s = 0; s < segments; ++s)
    addTriangle(mesh, south, at(rings - 1, s + 1), at(rings - 1, s));
  return mesh;
}

/// A closed torus (radii 1 and 0.35) with normals and texture coordinates 0 .. 1: rings * segments positions and, for
/// the seams, (rings + 1) * (segments + 1) wedges; 2 * rings * segments triangles. `rings` and `segments` are at
/// least 3.
inline Mesh torus(std::uint32_t rings, std::uint32_t segments) {
  assert(rings >= 3 && segments >= 3);
  Mesh mesh;
  mesh.name = "torus";
  const auto turn = [](std::uint32_t i, std::uint32_t n) { return 2 * std::numbers::pi * i / n; };
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < segments; ++s) {
      const double u = turn(r, rings), v = turn(s, segments), radius = 1 + 0.35 * std::cos(v);
      mesh.positions.push_back(Vec3f(Vec3d{radius * std::cos(u), 0.35 * std::sin(v), -radius * std::sin(u)}));
    }
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t s = 0; s <= segments; ++s) {
      const double u = turn(r % rings, rings), v = turn(s % segments, segments);
      mesh.wedgePositions.push_back(r % rings * segments + s % segments);
      mesh.normals.push_back(Vec3f(Vec3d{std::cos(v) * std::cos(u), std::sin(v), -std::cos(v) * std::sin(u)}));
      mesh.texCoords.push_back(
          {static_cast<float>(r) / static_cast<float>(rings), static_cast<float>(s) / static_cast<float>(segments)});
    }
  const auto at = [&](std::uint32_t r, std::uint32_t s) { return r * (segments + 1) + s; };
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < segments; ++s) {
      addTriangle(mesh, at(r, s), at(r + 1, s), at(r + 1, s + 1));
      addTriangle(mesh, at(r, s), at(r + 1, s + 1), at(r, s + 1));
    }
  return mesh;
}

/// An open, gently waved height field of n x n quads, without any attribute: (n + 1)^2 vertices, 2 n^2 triangles that
/// face +z. `n` is at least 1.
inline Mesh grid(std::uint32_t n) {
  assert(n >= 1);
  Mesh mesh;
  mesh.name = "grid";
  const float step = 1 / static_cast<float>(n);
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) {
      const float px = static_cast<float>(x) * step, py = static_cast<float>(y) * step;
      mesh.positions.push_back({px, py, 0.1f * px * py * (1 - py)});
    }
  addPlainWedges(mesh);
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return y * (n + 1) + x; };
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      addTriangle(mesh, at(x, y), at(x + 1, y), at(x + 1, y + 1));
      addTriangle(mesh, at(x, y), at(x + 1, y + 1), at(x, y + 1));
    }
  return mesh;
}

/// Triangles without connectivity: every corner has its own position. About every fourth position has the bits of an
/// earlier one, as in an STL file.
inline Mesh soup(std::uint32_t triangles, std::uint32_t seed) {
  Random random(seed);
  Mesh mesh;
  mesh.name = "soup";
  for (std::uint32_t corner = 0; corner < 3 * triangles; ++corner) {
    const bool repeat = corner > 0 && random.oneIn(4);
    mesh.positions.push_back(repeat ? mesh.positions[random.below(corner)] : random.point());
    mesh.corners.push_back(corner);
  }
  addPlainWedges(mesh);
  return mesh;
}

/// A non-manifold mesh: an edge with three triangles, neighbours of opposite orientation, two fans that share one
/// vertex, a triangle with two equal corners, a repeated triangle, and an unreferenced position.
inline Mesh nonManifold() {
  Mesh mesh;
  mesh.name = "non-manifold";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},  {0, -1, 0},  {0, 0, 1},
                    {2, 1, 0}, {2, 0, 1}, {1, -1, 1}, {-1, -1, 1}, {5, 5, 5}};
  addPlainWedges(mesh);
  addTriangle(mesh, 0, 1, 2); // edge 0-1 three times, twice in the same direction
  addTriangle(mesh, 0, 1, 3);
  addTriangle(mesh, 1, 0, 4);
  addTriangle(mesh, 1, 5, 6); // vertex 1 joins this fan to the one above
  addTriangle(mesh, 1, 6, 7);
  addTriangle(mesh, 4, 4, 8); // two equal corners
  addTriangle(mesh, 8, 7, 0);
  addTriangle(mesh, 7, 0, 8); // the same triangle, rotated
  return mesh;
}

/// `count` coloured points.
inline Mesh pointCloud(std::uint32_t count, std::uint32_t seed) {
  Random random(seed);
  Mesh mesh;
  mesh.name = "points";
  mesh.topology = Topology::points;
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.positions.push_back(random.point());
    mesh.colors.push_back(random.color());
    mesh.corners.push_back(i);
  }
  addPlainWedges(mesh);
  return mesh;
}

/// Polylines of random length between random points: some are closed, some meet a point of another, and one has no
/// length.
inline Mesh polylines(std::uint32_t count, std::uint32_t seed) {
  Random random(seed);
  Mesh mesh;
  mesh.name = "polylines";
  mesh.topology = Topology::lines;
  const auto addLine = [&](std::uint32_t a, std::uint32_t b) { mesh.corners.insert(mesh.corners.end(), {a, b}); };
  for (std::uint32_t line = 0; line < count; ++line) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const std::uint32_t length = 1 + random.below(random.oneIn(8) ? 200 : 12);
    for (std::uint32_t i = 0; i <= length; ++i) {
      mesh.positions.push_back(random.point());
      if (i > 0)
        addLine(first + i - 1, first + i);
    }
    if (random.oneIn(3))
      addLine(first + length, random.oneIn(2) ? first : random.below(first + 1));
  }
  addLine(0, 0);
  addPlainWedges(mesh);
  return mesh;
}

/// A random attribute of one to four components for `count` wedges. Its values are integers, fractions, or all equal.
inline NamedAttribute randomAttribute(Random& random, const std::string& name, std::uint32_t count) {
  const std::uint32_t kind = random.below(3), components = 1 + random.below(4);
  const float low = random.between(-1000, 1000), extent = std::exp2(static_cast<float>(random.below(20)) - 5);
  NamedAttribute attribute{name, components, {}};
  for (std::uint32_t i = 0; i < components * count; ++i) {
    const float value = low + extent * random.between(0, 1);
    attribute.values.push_back(kind == 0 ? std::floor(value) : kind == 1 ? value : low);
  }
  return attribute;
}

/// A shape for each mesh, named "part0", "part1", ...
inline Scene sceneOf(std::vector<Mesh> meshes) {
  Scene scene;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Shape shape;
    shape.mesh = i;
    addRoot(scene.graph, {"part" + std::to_string(i), shape, {}, ""});
  }
  scene.meshes = std::move(meshes);
  return scene;
}

/// The content of the first node of a type, or null.
template <typename T> const T* firstOf(const SceneGraph& graph) {
  for (const std::size_t node : nodesInOrder(graph))
    if (const T* content = std::get_if<T>(&graph.nodes[node].content))
      return content;
  return nullptr;
}

/// The name of the nth shape of a scene.
inline const std::string& shapeName(const SceneGraph& graph, std::size_t n) {
  return graph.nodes.at(shapeNodes(graph).at(n)).name;
}

/// The appearance of the nth shape of a scene, which must have one.
inline const Appearance& appearanceOf(const SceneGraph& graph, std::size_t n) {
  return graph.appearances.at(shapeOf(graph, shapeNodes(graph).at(n)).appearance.value());
}

/// One of the meshes above, at random, of random size and position, with or without each attribute, creases and seams
/// (positions with several wedges), degenerate and duplicate triangles. Consistent, finite and not empty.
inline Mesh randomMesh(std::uint32_t seed) {
  Random random(seed);
  Mesh mesh;
  // In separate statements, since the evaluation order of arguments is unspecified.
  const std::uint32_t kind = random.below(7), i = random.below(20), j = random.below(300), inner = random.bits();
  switch (kind) {
  case 0:
    mesh = sphere(2 + i, 3 + j % 20);
    break;
  case 1:
    mesh = torus(3 + i, 3 + j % 12);
    break;
  case 2:
    mesh = grid(1 + i);
    break;
  case 3:
    mesh = soup(1 + j, inner);
    break;
  case 4:
    mesh = nonManifold();
    break;
  case 5:
    mesh = pointCloud(1 + j, inner);
    break;
  case 6:
    mesh = polylines(1 + i, inner);
    break;
  }
  const float scale = std::exp2(static_cast<float>(random.below(21)) - 10);
  const Vec3f offset = random.oneIn(2) ? Vec3f{} : random.point() * (10 * scale);
  for (Vec3f& position : mesh.positions)
    position = position * scale + offset;

  if (mesh.topology == Topology::triangles) {
    for (std::uint32_t extra = random.oneIn(3) ? random.below(10) : 0; extra > 0; --extra) {
      const std::size_t at = 3 * random.below(mesh.elementCount());
      const std::uint32_t a = mesh.corners[at], b = mesh.corners[at + 1], c = mesh.corners[at + 2];
      if (random.oneIn(2))
        addTriangle(mesh, b, c, a); // duplicate
      else
        addTriangle(mesh, a, b, b); // degenerate
    }
  }
  if (mesh.topology != Topology::points) {
    // A crease or seam: some corners get a wedge of their own at the same position.
    if (random.oneIn(2))
      for (std::uint32_t& corner : mesh.corners)
        if (random.oneIn(8)) {
          mesh.wedgePositions.push_back(mesh.wedgePositions[corner]);
          corner = static_cast<std::uint32_t>(mesh.wedgeCount() - 1);
        }
  }
  mesh.normals.clear(), mesh.texCoords.clear(), mesh.colors.clear();
  const bool normals = random.oneIn(2), texCoords = random.oneIn(3), colors = random.oneIn(3);
  mesh.colorComponents = colors && random.oneIn(2) ? 4 : 3;
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    if (normals)
      mesh.normals.push_back(random.direction());
    if (texCoords) {
      const float u = random.between(-1, 2), v = random.between(0, 1);
      mesh.texCoords.push_back({u, v});
    }
    if (colors) {
      mesh.colors.push_back(random.color());
      if (mesh.colorComponents == 4)
        mesh.colors.back().a = static_cast<float>(random.below(256) / 255.0);
    }
  }
  for (std::uint32_t number = random.oneIn(3) ? 1 + random.below(3) : 0; number > 0; --number)
    mesh.namedAttributes.push_back(
        randomAttribute(random, "measure" + std::to_string(number), static_cast<std::uint32_t>(mesh.wedgeCount())));
  return mesh;
}

} // namespace imgeo::testing
