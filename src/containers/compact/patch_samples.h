#pragma once
// Sample patches for tests: together they use every feature of the compact format.

#include "containers/compact/compact_patch.h"
#include "containers/compact/header.h"
#include "containers/compact/quantise.h"
#include "containers/testing.h"
#include "prepare/weld.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace imgeo::compact::testing {

using imgeo::testing::Random;

/// A welded mesh on the lattice of its box, as one compact patch with all attributes of the mesh. Normals that are near
/// to their predictions are stored as these.
inline CompactPatch tolerantPatchOf(Mesh mesh, std::uint32_t bits, const AttributeBits& attributeBits = {}) {
  const Lattice lattice = latticeFor(boxOf(mesh), bits);
  weld(mesh);
  const PatchedMesh patched = cutIntoPatches(std::move(mesh), lattice, 65535);
  return quantise(patched.patches.at(0), describe(patched, {}), attributeBits);
}

/// The same with exact normals.
inline CompactPatch patchOf(Mesh mesh, std::uint32_t bits, const AttributeBits& attributeBits = {}) {
  CompactPatch patch = tolerantPatchOf(std::move(mesh), bits, attributeBits);
  for (Attribute& attribute : patch.attributes)
    attribute.sourceNormals.clear();
  return patch;
}

/// Adds an attribute of a type, whose values are random over its whole range.
inline void addRandom(CompactPatch& patch, const AttributeType& type, std::uint32_t seed) {
  Random random(seed);
  Attribute attribute{type, {}};
  const std::int32_t radius = (1 << (type.bits - 1)) - 1;
  for (std::size_t wedge = 0; wedge < patch.wedgeCount(); ++wedge) {
    Value& value = attribute.values.emplace_back();
    if (type.kind == AttributeKind::normal) {
      const auto below = [&](std::int32_t n) {
        return static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(n)));
      };
      const auto either = [&](std::int32_t n) { return random.oneIn(2) ? n : -n; };
      const std::int32_t x = below(radius + 1), y = below(radius - x + 1);
      value = {{either(x), either(y), either(radius - x - y), 0}};
      continue;
    }
    for (std::uint32_t i = 0; i < type.components; ++i)
      value[i] = static_cast<std::int32_t>(random.bits() >> (32 - type.bits));
  }
  patch.attributes.push_back(std::move(attribute));
}

/// A cube with flat faces: each vertex has three wedges, one per face.
inline Mesh creasedCube() {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i)
    mesh.positions.push_back({float(i & 1), float(i >> 1 & 1), float(i >> 2)});
  for (int axis = 0; axis < 3; ++axis)
    for (const std::uint32_t side : {0u, 1u}) {
      const std::uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, at = side << axis;
      const std::uint32_t first = static_cast<std::uint32_t>(mesh.wedgeCount());
      for (const std::uint32_t corner : {at, at + u, at + u + v, at + v}) {
        mesh.wedgePositions.push_back(corner);
        Vec3f normal;
        normal[axis] = side == 1 ? 1.0f : -1.0f;
        mesh.normals.push_back(normal);
      }
      const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        side == 1 ? imgeo::testing::addTriangle(mesh, first + a, first + b, first + c)
                  : imgeo::testing::addTriangle(mesh, first + a, first + c, first + b);
      };
      add(0, 1, 2);
      add(0, 2, 3);
    }
  return mesh;
}

/// A cone whose triangles each have one random normal: its apex has a wedge for each triangle, each rim vertex has two
/// wedges.
inline Mesh flatCone(std::uint32_t triangles) {
  Mesh mesh;
  mesh.positions.push_back({0, 0, 1});
  Random random(triangles);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const double angle = 2 * std::numbers::pi * i / triangles;
    mesh.positions.push_back(Vec3f(Vec3d{std::cos(angle), std::sin(angle), 0}));
  }
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vec3f normal = random.direction();
    for (const std::uint32_t position : {0u, 1 + i, 1 + (i + 1) % triangles}) {
      mesh.corners.push_back(static_cast<std::uint32_t>(mesh.wedgeCount()));
      mesh.wedgePositions.push_back(position);
      mesh.normals.push_back(normal);
    }
  }
  return mesh;
}

/// A height field over a regular grid in x and y.
inline Mesh terrain(std::uint32_t n) {
  Mesh mesh = imgeo::testing::grid(n);
  Random random(n);
  for (Vec3f& position : mesh.positions)
    position.z = random.between(0, 0.4f);
  return mesh;
}

/// A fan of triangles around one vertex, without seams.
inline Mesh star(std::uint32_t triangles) {
  Mesh mesh = flatCone(triangles);
  mesh.corners.clear();
  for (std::uint32_t i = 0; i < triangles; ++i)
    imgeo::testing::addTriangle(mesh, 0, 1 + i, 1 + (i + 1) % triangles);
  mesh.normals.clear();
  mesh.wedgePositions.clear();
  imgeo::testing::addPlainWedges(mesh);
  return mesh;
}

/// A base of three segments: positions that segments share are exact, others are rounded.
inline CompactPatch baseOf(const Mesh& mesh, NormalMode normals = NormalMode::derivedArea) {
  CompactPatch base = patchOf(mesh, 16, {8, 12, 8, normals});
  base.segmentCount = 3;
  base.residualShift = 6;
  for (std::size_t corner = 0; corner < base.corners.size(); corner += 3) {
    const Vec3u& at = base.positions[base.wedgePositions[base.corners[corner]]];
    base.segments.push_back(at.x < 30000 ? 0 : at.y < 30000 ? 1 : 2);
  }
  return base;
}

/// The patches of a file and the name of the file.
struct Sample {
  std::string name;
  std::vector<CompactPatch> patches;

  Sample(std::string fileName, CompactPatch patch) : name(std::move(fileName)), patches{std::move(patch)} {}
  Sample(std::string fileName, std::vector<CompactPatch> all) : name(std::move(fileName)), patches(std::move(all)) {}
  CompactPatch& firstPatch() { return patches[0]; }
  const CompactPatch& firstPatch() const { return patches[0]; }
};

/// Files of one patch.
inline std::vector<Sample> samples() {
  using namespace imgeo::testing;
  const auto colored = [](Mesh mesh, std::uint32_t components) {
    Random random(components);
    mesh.colorComponents = components;
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
      mesh.colors.push_back(random.color());
      if (components == 4)
        mesh.colors.back().a = static_cast<float>((random.bits() & 255) / 255.0);
    }
    return mesh;
  };
  Mesh oneTriangle;
  oneTriangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  addPlainWedges(oneTriangle);
  addTriangle(oneTriangle, 0, 1, 2);

  std::vector<Sample> samples;
  samples.push_back({"triangle", patchOf(oneTriangle, 8)});
  samples.push_back({"sphere", patchOf(sphere(12, 16), 16)});
  samples.push_back({"sphere-derived", patchOf(sphere(5, 6), 12, {16, 12, 8, NormalMode::derivedArea})});
  samples.push_back({"torus", patchOf(colored(torus(12, 9), 4), 14, {10, 12, 8, NormalMode::uniform})});
  samples.push_back({"torus-plain-colors", patchOf(colored(torus(9, 12), 3), 11, {4, 16, 5, NormalMode::area})});
  samples.push_back({"cube", patchOf(creasedCube(), 10)});
  samples.push_back({"cube-derived", patchOf(creasedCube(), 10, {8, 12, 8, NormalMode::derivedUniform})});
  samples.push_back({"cone", patchOf(flatCone(40), 16)});
  samples.push_back({"terrain", patchOf(terrain(12), 16)});
  samples.push_back({"star", patchOf(star(300), 16)});
  samples.push_back({"soup", patchOf(soup(60, 5), 16)});
  samples.push_back({"non-manifold", patchOf(nonManifold(), 16)});
  samples.push_back({"fine", patchOf(sphere(6, 8), 30)});
  samples.push_back({"coarse", patchOf(sphere(20, 20), 8)});
  samples.push_back({"lines", patchOf(colored(polylines(9, 3), 3), 16)});
  samples.push_back({"points", patchOf(pointCloud(90, 4), 16)});
  Mesh pointsWithNormals = pointCloud(40, 6);
  Random random(1);
  for (std::size_t i = 0; i < pointsWithNormals.wedgeCount(); ++i)
    pointsWithNormals.normals.push_back(random.direction());
  samples.push_back({"points-with-normals", patchOf(pointsWithNormals, 20)});
  samples.push_back({"others", patchOf(torus(5, 7), 16)});
  addRandom(samples.back().firstPatch(), {AttributeKind::other, 1, 24, NormalMode::area}, 1);
  addRandom(samples.back().firstPatch(), {AttributeKind::other, 4, 3, NormalMode::area}, 2);
  samples.push_back({"base", baseOf(sphere(12, 16))});
  samples.push_back({"base-colors", baseOf(colored(grid(6), 3))});
  samples.push_back({"base-seams", baseOf(torus(8, 6))});
  addRandom(samples.back().firstPatch(), {AttributeKind::other, 2, 11, NormalMode::area}, 3);
  return samples;
}

/// Random elements over `vertexCount` random points with `wedgeCount` wedges. Elements use every wedge if they have
/// at least `wedgeCount` corners.
inline CompactPatch tangle(Topology topology, std::uint32_t vertexCount, std::uint32_t wedgeCount,
                           std::uint32_t elementCount, std::uint32_t bits) {
  Random random(wedgeCount);
  CompactPatch patch;
  patch.topology = topology;
  patch.positionBits = bits;
  const auto coordinate = [&] { return random.bits() >> (32 - bits); };
  for (std::uint32_t i = 0; i < vertexCount; ++i)
    patch.positions.push_back({coordinate(), coordinate(), coordinate()});
  for (std::uint32_t i = 0; i < wedgeCount; ++i)
    patch.wedgePositions.push_back(i % vertexCount);
  const auto cornerCount = static_cast<std::uint32_t>(elementCount * cornersPerElement(topology));
  for (std::uint32_t i = 0; i < cornerCount; ++i)
    patch.corners.push_back(i < wedgeCount ? i : random.below(wedgeCount));
  return patch;
}

/// Gives every wedge the value of the first wedge of its vertex, except for about one wedge in `once`.
inline void repeatValues(CompactPatch& patch, std::uint32_t once) {
  Random random(once);
  for (Attribute& attribute : patch.attributes)
    for (std::uint32_t wedge = 0; wedge < patch.wedgeCount(); ++wedge)
      if (!random.oneIn(once))
        attribute.values[wedge] = attribute.values[patch.wedgePositions[wedge] % patch.positions.size()];
}

/// Samples of features that meshes seldom need.
inline std::vector<Sample> rareSamples() {
  using enum AttributeKind;
  using enum NormalMode;
  std::vector<Sample> samples;
  // Triangles between random vertices: a patch that is no surface.
  samples.push_back({"tangle", tangle(Topology::triangles, 40, 60, 120, 16)});
  addRandom(samples.back().firstPatch(), {normal, 3, 8, area}, 1);
  addRandom(samples.back().firstPatch(), {texCoord, 2, 9, area}, 2);
  addRandom(samples.back().firstPatch(), {color, 3, 8, area}, 3);
  addRandom(samples.back().firstPatch(), {other, 3, 7, area}, 4);
  repeatValues(samples.back().firstPatch(), 4);
  // Vertices with more wedges than a step around the vertex can address.
  samples.push_back({"crowded", tangle(Topology::triangles, 5, 120, 300, 12)});
  addRandom(samples.back().firstPatch(), {normal, 3, 16, uniform}, 5);
  samples.push_back({"lines-with-seams", tangle(Topology::lines, 30, 50, 80, 16)});
  addRandom(samples.back().firstPatch(), {normal, 3, 6, area}, 6);
  addRandom(samples.back().firstPatch(), {texCoord, 2, 10, area}, 7);
  addRandom(samples.back().firstPatch(), {color, 4, 16, area}, 8);
  repeatValues(samples.back().firstPatch(), 3);
  samples.push_back({"points-with-all", tangle(Topology::points, 30, 30, 30, 24)});
  addRandom(samples.back().firstPatch(), {texCoord, 2, 16, area}, 9);
  addRandom(samples.back().firstPatch(), {other, 2, 24, area}, 10);
  addRandom(samples.back().firstPatch(), {normal, 3, 8, derivedArea}, 11);
  // The smallest number of bits of each value: many positions are equal, so triangles have no area.
  samples.push_back({"fewest-bits", tangle(Topology::triangles, 20, 25, 40, 1)});
  addRandom(samples.back().firstPatch(), {normal, 3, 4, area}, 12);
  addRandom(samples.back().firstPatch(), {texCoord, 2, 1, area}, 13);
  addRandom(samples.back().firstPatch(), {color, 3, 1, area}, 14);
  addRandom(samples.back().firstPatch(), {other, 1, 1, area}, 15);
  samples.push_back({"most-attributes", tangle(Topology::triangles, 6, 8, 9, 30)});
  constexpr std::uint8_t componentCounts[] = {3, 2, 4, 4}; // by AttributeKind
  for (std::uint32_t i = 0; i < maxAttributes; ++i)
    addRandom(samples.back().firstPatch(),
              {static_cast<AttributeKind>(i % 4), componentCounts[i % 4], static_cast<std::uint8_t>(4 + i % 13),
               i % 4 == 0 ? static_cast<NormalMode>(i / 4) : area},
              20 + i);
  // A base with a grid: coordinates on the grid are exact, others are rounded.
  samples.push_back({"base-grid", baseOf(terrain(9), derivedUniform)});
  return samples;
}

/// The points of an isosurface-like grid whose lines are 2^`shift` lattice steps apart, as hierarchies round them, and
/// a few points beside it.
inline CompactPatch roundedSphere(std::uint32_t bits, std::uint32_t shift) {
  CompactPatch patch = patchOf(imgeo::testing::sphere(16, 20), bits);
  Random random(bits);
  for (Vec3u& position : patch.positions)
    for (int axis = 0; axis < 3; ++axis)
      if (!random.oneIn(20))
        position[axis] = position[axis] >> shift << shift;
  const std::uint64_t step = std::uint64_t{1} << (shift + 16);
  patch.grid = VertexGrid{{0, 0, 0}, {step, step, step}};
  return patch;
}

/// Samples of what only version 2 can state: grids of more than 16 bits.
inline std::vector<Sample> samplesOfVersion2() {
  std::vector<Sample> samples;
  samples.push_back({"grid-18-bits", roundedSphere(18, 5)});
  samples.push_back({"grid-24-bits", roundedSphere(24, 17)});
  samples.push_back({"no-grid-25-bits", patchOf(imgeo::testing::sphere(9, 9), 25)});
  return samples;
}

/// Files of one patch and files of several patches.
inline std::vector<Sample> files(Version version = Version::two) {
  std::vector<Sample> files = samples();
  const auto patchesNamed = [&](std::initializer_list<const char*> names) {
    std::vector<CompactPatch> patches;
    for (const char* name : names)
      patches.push_back(std::ranges::find(files, name, &Sample::name)->firstPatch());
    return patches;
  };
  std::vector<CompactPatch> spheres;
  for (std::uint32_t i = 3; i < 12; ++i)
    spheres.push_back(patchOf(imgeo::testing::sphere(i, i + 1), 12));
  const auto several = patchesNamed({"cube", "sphere", "lines", "others", "terrain", "points-with-normals", "torus",
                                     "cube", "torus-plain-colors", "sphere-derived"}),
             bases = patchesNamed({"base", "base-colors", "base"});
  files.emplace_back("alike", std::move(spheres));
  files.emplace_back("several", several);
  files.emplace_back("bases", bases);
  std::ranges::move(rareSamples(), std::back_inserter(files));
  if (version != Version::one)
    std::ranges::move(samplesOfVersion2(), std::back_inserter(files));
  return files;
}

} // namespace imgeo::compact::testing
