#pragma once
// Motions that only the benchmark of live frames has: noise, a bent model and a walking figure.

#include "imgeo/convert.h"
#include "imgeo/site.h"
#include "motions/motion.h"
#include "motions/random.h"

#include <cmath>
#include <filesystem>
#include <memory>

namespace imgeo {

/// A motion whose vertices the triangles of a mesh join; the benchmark predicts vertices along them.
class MeshMotion : public Motion {
public:
  /// Three vertices for each triangle.
  const std::vector<std::uint32_t>& indices() const { return indices_; }

protected:
  std::vector<std::uint32_t> indices_;
};

/// Positions without any order.
class Noise final : public Motion {
public:
  explicit Noise(std::uint32_t grid) : random_(1) {
    columns_ = grid;
    positions_.resize(std::size_t{grid} * grid);
    box_.add({-1, -1, -1});
    box_.add({1, 1, 1});
    advance(1);
  }
  void advance(double) override {
    for (Vec3f& position : positions_)
      position = {2 * random_.unit() - 1, 2 * random_.unit() - 1, 2 * random_.unit() - 1};
  }

private:
  Random random_;
};

/// A mesh that turns about the y axis, the more the higher its vertices are, forth and back.
class Bending final : public MeshMotion {
public:
  Bending(std::vector<Vec3f> rest, std::vector<std::uint32_t> indices) : rest_(std::move(rest)) {
    indices_ = std::move(indices);
    positions_ = rest_;
    Box3d box;
    for (const Vec3f position : rest_)
      box.add(Vec3d(position));
    center_ = Vec3f(box.center());
    const double radius = box.longestEdge();
    box_.add(box.center() + Vec3d{-radius, -radius, -radius});
    box_.add(box.center() + Vec3d{radius, radius, radius});
    size_ = static_cast<float>(radius);
  }
  void advance(double seconds) override {
    time_ += static_cast<float>(seconds);
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const Vec3f p = rest_[i] - center_;
      const float angle = 0.8F * std::sin(2 * time_ + 3 * p.y / size_);
      positions_[i] = center_ + Vec3f{p.x * std::cos(angle) - p.z * std::sin(angle), p.y,
                                      p.x * std::sin(angle) + p.z * std::cos(angle)};
    }
  }

private:
  std::vector<Vec3f> rest_;
  Vec3f center_;
  float size_ = 1, time_ = 0;
};

/// The vertices of a model in the order in which imgeo encodes them.
inline std::unique_ptr<MeshMotion> makeBending(const std::string& model, const std::filesystem::path& folder) {
  ConvertOptions options;
  options.pictures = false;
  options.encoding = Encoding::compact;
  convert(model, folder / "site", options);
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> indices;
  for (const SiteMesh& mesh : readSiteMeshes(folder / "site").meshes) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const auto& [x, y, z] : mesh.positions)
      positions.push_back({x, y, z});
    for (const std::uint32_t index : mesh.indices)
      indices.push_back(first + index);
  }
  return std::make_unique<Bending>(std::move(positions), std::move(indices));
}

/// A figure of six rounded tubes that walks on the spot: arms and legs swing and bend smoothly at elbows and knees, as
/// a mesh under a skin of two bones does.
class Walker final : public MeshMotion {
public:
  Walker() {
    addTube({0, 0.95F, 0}, {0, 1.5F, 0}, 0.16F, 0);         // trunk
    addTube({0, 1.55F, 0}, {0, 1.82F, 0}, 0.11F, 0);        // head
    addTube({-0.11F, 0.95F, 0}, {-0.11F, 0, 0}, 0.085F, 1); // legs
    addTube({0.11F, 0.95F, 0}, {0.11F, 0, 0}, 0.085F, -1);
    addTube({-0.24F, 1.45F, 0}, {-0.24F, 0.8F, 0}, 0.05F, -1); // arms
    addTube({0.24F, 1.45F, 0}, {0.24F, 0.8F, 0}, 0.05F, 1);
    box_.add({-1, -0.1, -1});
    box_.add({1, 2, 1});
    advance(0.01);
  }
  void advance(double seconds) override {
    time_ += static_cast<float>(seconds);
    for (const Tube& tube : tubes_)
      pose(tube);
  }

private:
  static constexpr std::uint32_t around = 48, along = 64;

  struct Tube {
    Vec3f start, end;
    float radius, phase;
    std::size_t first;
  };

  void addTube(Vec3f start, Vec3f end, float radius, float phase) {
    const auto first = static_cast<std::uint32_t>(positions_.size());
    tubes_.push_back({start, end, radius, phase, first});
    positions_.resize(first + std::size_t{around} * along);
    for (std::uint32_t row = 1; row < along; ++row)
      for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t a = first + row * around + i, b = first + row * around + (i + 1) % around;
        indices_.insert(indices_.end(), {a - around, a, b, a - around, b, b - around});
      }
  }

  void pose(const Tube& tube) {
    const float swing = 0.5F * tube.phase * std::sin(5 * time_),
                bend = 0.6F * std::abs(tube.phase) * (1 - std::cos(5 * time_ + tube.phase)) / 2;
    const Vec3f axis = tube.end - tube.start;
    for (std::uint32_t row = 0; row < along; ++row) {
      const float t = static_cast<float>(row) / (along - 1);
      // The second half turns on at the joint, blended over a fifth of the tube.
      const float blend = std::clamp((t - 0.4F) / 0.2F, 0.0F, 1.0F);
      const float radius = tube.radius * std::sqrt(std::max(0.02F, 1 - std::pow(2 * t - 1, 8.0F)));
      for (std::uint32_t i = 0; i < around; ++i) {
        const float angle = 6.2831853F * static_cast<float>(i) / around;
        const Vec3f straight = axis * t + Vec3f{radius * std::cos(angle), 0, radius * std::sin(angle)};
        const Vec3f joint = axis * 0.5F;
        const Vec3f bent = joint + turned(straight - joint, tube.phase > 0 ? bend : -bend);
        positions_[tube.first + std::size_t{row} * around + i] = tube.start +
                                                                 turned(straight * (1 - blend) + bent * blend, swing) +
                                                                 Vec3f{0, 0.03F * std::cos(10 * time_), 0};
      }
    }
  }

  /// Turned about the x axis.
  static Vec3f turned(Vec3f p, float angle) {
    return {p.x, p.y * std::cos(angle) - p.z * std::sin(angle), p.y * std::sin(angle) + p.z * std::cos(angle)};
  }

  std::vector<Tube> tubes_;
  float time_ = 0;
};

} // namespace imgeo
