#include "transcode/source/guess_up.h"

#include "scene/testing.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace imgeo {
namespace {

using Profile = std::vector<Vec2<double>>; ///< radius and height

/// Surfaces of generated models whose y axis points up.
class Model {
public:
  Model& box(Vec3d from, Vec3d to) {
    const auto corner = [&](int i) {
      return Vec3d{i & 1 ? to.x : from.x, i & 2 ? to.y : from.y, i & 4 ? to.z : from.z};
    };
    for (const std::array<int, 4> face : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                          std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
      quad(corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3]));
    return *this;
  }

  /// A gable roof over a rectangle, open below, with its ridge along x.
  Model& roof(Vec3d from, Vec3d to) {
    const double z = (from.z + to.z) / 2;
    const Vec3d ridgeA{from.x, to.y, z}, ridgeB{to.x, to.y, z};
    const Vec3d a{from.x, from.y, from.z}, b{to.x, from.y, from.z}, c{to.x, from.y, to.z}, d{from.x, from.y, to.z};
    quad(d, c, ridgeB, ridgeA);
    quad(b, a, ridgeA, ridgeB);
    triangle(a, d, ridgeA);
    triangle(c, b, ridgeB);
    return *this;
  }

  /// A surface of revolution around an axis parallel to y.
  Model& lathe(const Profile& profile, Vec3d foot = {}, double lean = 0) {
    constexpr int segments = 24;
    const auto at = [&](std::size_t ring, int segment) {
      const double angle = 2 * std::numbers::pi * segment / segments, height = profile[ring].y;
      return foot + Vec3d{profile[ring].x * std::cos(angle) + lean * height,
                          height - lean * profile[ring].x * std::cos(angle), -profile[ring].x * std::sin(angle)};
    };
    for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring)
      for (int segment = 0; segment < segments; ++segment)
        quad(at(ring, segment), at(ring, segment + 1), at(ring + 1, segment + 1), at(ring + 1, segment));
    return *this;
  }

  Model& ellipsoid(Vec3d center, Vec3d radius) {
    Profile profile;
    for (int i = 0; i <= 12; ++i) {
      const double angle = std::numbers::pi * (i / 12.0 - 0.5);
      profile.push_back({std::cos(angle), std::sin(angle)});
    }
    const std::size_t first = mesh_.positions.size();
    lathe(profile);
    for (std::size_t i = first; i < mesh_.positions.size(); ++i) {
      const Vec3d p(mesh_.positions[i]);
      mesh_.positions[i] = Vec3f(center + Vec3d{p.x * radius.x, p.y * radius.y, p.z * radius.z});
    }
    return *this;
  }

  Model& terrain(double size, const std::function<double(double x, double z)>& height) {
    constexpr int cells = 60;
    const auto at = [&](int i, int k) {
      const double x = size * i / cells, z = size * k / cells;
      return Vec3d{x, height(x, z), z};
    };
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k)
        quad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
    return *this;
  }

  Model& movedBy(Vec3d offset) {
    for (Vec3f& position : mesh_.positions)
      position += Vec3f(offset);
    return *this;
  }

  /// Reverses the winding of all triangles.
  Model& reversed() {
    for (std::size_t i = 0; i + 2 < mesh_.corners.size(); i += 3)
      std::swap(mesh_.corners[i], mesh_.corners[i + 1]);
    return *this;
  }

  const Mesh& mesh() const { return mesh_; }

private:
  void triangle(Vec3d a, Vec3d b, Vec3d c) {
    for (const Vec3d& corner : {a, b, c}) {
      mesh_.corners.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
      mesh_.wedgePositions.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
      mesh_.positions.push_back(Vec3f(corner));
    }
  }
  void quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

  Mesh mesh_;
};

const Profile figure{{0.9, 0}, {0.9, 0.3}, {0.5, 0.35}, {0.3, 1}, {0.55, 1.6},
                     {0.6, 2}, {0.2, 2.5}, {0.3, 2.8},  {0, 3.1}};

Profile closedBelow(Profile profile) {
  profile.insert(profile.begin(), {0, profile.front().y});
  return profile;
}

double hills(double x, double z) {
  return 0.05 * (std::sin(9 * x) + std::sin(7 * z + 1) + 0.4 * std::sin(31 * x + 17 * z));
}

struct NamedModel {
  const char* name;
  Model model;
};

std::vector<NamedModel> statues() {
  return {
      {"figure", Model().lathe(closedBelow(figure))},
      {"hollow figure", Model().lathe(figure)},
      {"figure on a square plinth", Model().lathe(figure, {0, 1, 0}).box({-1, 0, -1}, {1, 1, 1})},
      {"leaning scan", Model().lathe(closedBelow(figure), {5, 3, 8}, 0.06)},
      {"bust", Model().lathe(closedBelow({{0.5, 0}, {0.3, 0.4}, {1, 0.8}})).ellipsoid({0, 1.5, 0.1}, {0.6, 0.9, 0.7})},
      {"quadruped", Model()
                        .ellipsoid({0, 1.2, 0}, {0.4, 0.4, 1})
                        .ellipsoid({0, 1.8, 1.2}, {0.2, 0.3, 0.4})
                        .box({-0.3, 0, -0.8}, {-0.1, 1.2, -0.6})
                        .box({0.1, 0, -0.7}, {0.3, 1.2, -0.5})
                        .box({-0.3, 0, 0.6}, {-0.1, 1.2, 0.8})
                        .box({0.1, 0, 0.5}, {0.3, 1.2, 0.7})},
      {"human with spread arms", Model()
                                     .ellipsoid({0, 1.2, 0}, {0.25, 0.4, 0.15})
                                     .ellipsoid({0, 1.75, 0}, {0.1, 0.15, 0.12})
                                     .ellipsoid({0.5, 1.5, 0}, {0.45, 0.06, 0.06})
                                     .ellipsoid({-0.5, 1.5, 0}, {0.45, 0.06, 0.06})
                                     .ellipsoid({0.12, 0.45, 0}, {0.09, 0.45, 0.1})
                                     .ellipsoid({-0.12, 0.45, 0}, {0.09, 0.45, 0.1})
                                     .box({0.05, -0.05, -0.1}, {0.2, 0.03, 0.2})
                                     .box({-0.2, -0.05, -0.1}, {-0.05, 0.03, 0.2})},
      {"obelisk", Model().lathe(closedBelow({{1, 0}, {1, 0.5}, {0.5, 0.6}, {0.3, 6}, {0, 6.5}}))},
      {"column",
       Model().lathe({{0, 0}, {0.5, 0}, {0.5, 0.2}, {0.35, 0.3}, {0.3, 4}, {0.5, 4.2}, {0.5, 4.4}, {0, 4.4}})},
      {"chair", Model()
                    .box({0, 0, 0}, {0.05, 0.45, 0.05})
                    .box({0.4, 0, 0}, {0.45, 0.45, 0.05})
                    .box({0, 0, 0.4}, {0.05, 0.45, 0.45})
                    .box({0.4, 0, 0.4}, {0.45, 0.45, 0.45})
                    .box({0, 0.45, 0}, {0.45, 0.5, 0.45})
                    .box({0, 0.5, 0}, {0.45, 1, 0.05})},
  };
}

std::vector<NamedModel> terrains() {
  const auto steep = [](double x, double z) {
    return 0.12 * std::abs(std::sin(6 * x)) + 0.1 * std::abs(std::sin(5 * z));
  };
  return {
      {"hills", Model().terrain(2, hills)},
      {"hills, wound the other way", Model().terrain(2, hills).reversed()},
      {"mountains", Model().terrain(2, steep)},
      {"a plain", Model().terrain(200, [](double x, double z) { return 0.2 * std::sin(x) * std::cos(z); })},
      {"a slope", Model().terrain(2, [](double x, double z) { return 0.35 * x + hills(x, z); })},
      {"far from the origin", Model()
                                  .terrain(500, [](double x, double z) { return 30 * hills(x / 90, z / 90); })
                                  .movedBy({50000, 1200, 80000})},
      {"a village",
       Model().terrain(2, hills).box({0.4, -0.1, 0.4}, {0.6, 0.3, 0.6}).box({1, -0.1, 1}, {1.3, 0.25, 1.2})},
  };
}

std::vector<NamedModel> buildings() {
  Model tower, city, temple;
  for (int floor = 0; floor < 12; ++floor)
    tower.box({-5, 3.0 * floor, -5}, {5, 3.0 * floor + 0.3, 5})
        .box({-4.8, 3.0 * floor, -4.8}, {4.8, 3.0 * floor + 3, 4.8});
  tower.box({-9, -0.3, -9}, {9, 0, 9});
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 5; ++k)
      city.box({30.0 * i, 0, 30.0 * k}, {30.0 * i + 18, 12.0 + (i * 7 + k * 11) % 5 * 9, 30.0 * k + 20});
  temple.box({0, 0, 0}, {10, 0.6, 20});
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 7; ++k)
      temple.lathe({{0.5, 0.6}, {0.4, 5}}, {1 + i * 2.6, 0, 1 + k * 3.0});
  temple.box({0, 5, 0}, {10, 5.6, 20}).roof({0, 5.6, 0}, {10, 7.5, 20});
  return {
      {"house", Model().box({0, 0, 0}, {12, 6, 8}).roof({-0.5, 6, -0.5}, {12.5, 10, 8.5})},
      {"house without a floor", Model().roof({0, 6, 0}, {12, 10, 8}).lathe({{4, 0}, {4, 6}}, {6, 0, 4})},
      {"church", Model()
                     .box({0, 0, 0}, {30, 12, 12})
                     .roof({0, 12, 0}, {30, 20, 12})
                     .box({-8, 0, 2}, {0, 28, 10})
                     .lathe({{4, 28}, {0, 40}}, {-4, 0, 6})},
      {"block on the ground plane", Model().box({-10, 0, -6}, {10, 9, 6})},
      {"tower", tower},
      {"city", city},
      {"temple", temple},
      {"dome", Model().box({-10, 0, -10}, {10, 8, 10}).ellipsoid({0, 8, 0}, {8, 8, 8})},
  };
}

/// The mesh turned so that its y axis becomes another one.
Mesh turnedTo(AxisDirection up, Mesh mesh) {
  for (Vec3f& p : mesh.positions)
    p = up == AxisDirection::x ? Vec3f{p.y, -p.x, p.z} : up == AxisDirection::z ? Vec3f{p.x, -p.z, p.y} : p;
  return mesh;
}

/// The same positions as a point cloud, as dense everywhere.
Mesh pointsOf(const Mesh& mesh) {
  Mesh points;
  points.topology = Topology::points;
  for (const SurfaceSample& sample : surfaceSamples(testing::sceneOf({mesh}), 20000)) {
    points.corners.push_back(static_cast<std::uint32_t>(points.positions.size()));
    points.wedgePositions.push_back(static_cast<std::uint32_t>(points.positions.size()));
    points.positions.push_back(Vec3f(sample.point));
  }
  return points;
}

UpGuess guessFor(const Mesh& mesh) {
  return guessUp(surfaceSamples(testing::sceneOf({mesh}), 20000));
}

void expectGuesses(const std::vector<NamedModel>& models) {
  for (const NamedModel& named : models)
    for (const AxisDirection up : {AxisDirection::x, AxisDirection::y, AxisDirection::z}) {
      const UpGuess guess = guessFor(turnedTo(up, named.model.mesh()));
      EXPECT_EQ(guess.up, up) << named.name << " along " << nameOf(up) << ": " << guess.reason;
      const UpGuess ofPoints = guessFor(turnedTo(up, pointsOf(named.model.mesh())));
      EXPECT_EQ(ofPoints.up, up) << "points of " << named.name << " along " << nameOf(up) << ": " << ofPoints.reason;
    }
}

TEST(GuessUp, FindsTheAxisAlongWhichStatuesStand) {
  expectGuesses(statues());
}

TEST(GuessUp, FindsTheAxisAcrossTerrains) {
  expectGuesses(terrains());
}

TEST(GuessUp, FindsTheAxisAlongWhichBuildingsStand) {
  expectGuesses(buildings());
}

TEST(GuessUp, KeepsYWhereTheShapeTellsNothing) {
  EXPECT_EQ(guessFor(Model().ellipsoid({}, {1, 1, 1}).mesh()).up, AxisDirection::y);
  EXPECT_EQ(guessFor(Model().box({1, 1, 1}, {2, 4, 3}).mesh()).up, AxisDirection::y);
  EXPECT_EQ(guessFor(turnedTo(AxisDirection::z, Model().terrain(1, [](double, double) { return 0; }).mesh())).up,
            AxisDirection::y);
  EXPECT_EQ(guessUp({}).up, AxisDirection::y);
}

} // namespace
} // namespace imgeo
