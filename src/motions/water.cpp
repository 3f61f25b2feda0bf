#include "motions/motion.h"
#include "motions/random.h"

#include <algorithm>

namespace imgeo {

namespace {

constexpr float poolEdge = 4, waveSpeed = 1.2F, maxHeight = 0.25F;
constexpr float waveDamping = 0.35F; ///< share of the speed that is lost in a second
constexpr float dropsPerSecond = 2.5F;

class Water final : public Motion {
public:
  Water(std::uint32_t grid, std::uint32_t seed)
      : random_(seed), spacing_(poolEdge / static_cast<float>(grid - 1)), heights_(std::size_t{grid} * grid),
        speeds_(heights_.size()) {
    columns_ = grid;
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      const std::size_t column = i % grid, row = i / grid;
      positions_.push_back(
          {static_cast<float>(column) * spacing_ - poolEdge / 2, 0, static_cast<float>(row) * spacing_ - poolEdge / 2});
    }
    values_.assign(heights_.size(), 0.5F);
    box_.add({-poolEdge / 2, -maxHeight, -poolEdge / 2});
    box_.add({poolEdge / 2, maxHeight, poolEdge / 2});
  }

  void advance(double seconds) override {
    addDrops(static_cast<float>(seconds));
    // The scheme is stable while a wave crosses less than 0.7 cells in a step.
    const int steps = static_cast<int>(std::ceil(static_cast<float>(seconds) * waveSpeed / (0.5F * spacing_)));
    for (int i = 0; i < steps; ++i)
      advanceBy(static_cast<float>(seconds) / static_cast<float>(steps));
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      positions_[i].y = std::clamp(heights_[i], -maxHeight, maxHeight);
      values_[i] = 0.5F + positions_[i].y / (2 * maxHeight);
    }
  }

private:
  /// A drop pushes the surface down where it falls, and up around that.
  void addDrops(float seconds) {
    if (random_.unit() >= dropsPerSecond * seconds)
      return;
    const float x = poolEdge * (random_.unit() - 0.5F), z = poolEdge * (random_.unit() - 0.5F);
    const float radius = 0.12F + 0.15F * random_.unit(), depth = 0.05F + 0.08F * random_.unit();
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      const float dx = positions_[i].x - x, dz = positions_[i].z - z;
      const float square = (dx * dx + dz * dz) / (radius * radius);
      if (square < 9)
        heights_[i] -= depth * (1 - square) * std::exp(-square);
    }
  }

  void advanceBy(float step) {
    const float factor = step * waveSpeed * waveSpeed / (spacing_ * spacing_), kept = 1 - waveDamping * step;
    const std::size_t grid = columns_;
    for (std::size_t row = 0; row < grid; ++row) {
      // Waves are reflected at the border.
      const float* height = &heights_[row * grid];
      const float* above = row > 0 ? height - grid : height;
      const float* below = row + 1 < grid ? height + grid : height;
      float* speed = &speeds_[row * grid];
      const auto push = [&](std::size_t i, float left, float right) {
        speed[i] = kept * speed[i] + factor * (left + right + above[i] + below[i] - 4 * height[i]);
      };
      push(0, height[0], height[1]);
#pragma omp simd
      for (std::size_t i = 1; i < grid - 1; ++i)
        push(i, height[i - 1], height[i + 1]);
      push(grid - 1, height[grid - 2], height[grid - 1]);
    }
    for (std::size_t i = 0; i < heights_.size(); ++i)
      heights_[i] += step * speeds_[i];
  }

  Random random_;
  float spacing_;
  std::vector<float> heights_, speeds_;
};

} // namespace

std::unique_ptr<Motion> makeWater(std::uint32_t grid, std::uint32_t seed) {
  return std::make_unique<Water>(grid, seed);
}

std::unique_ptr<Motion> makeMotion(const std::string& name, std::uint32_t grid, std::uint32_t seed) {
  if (name == "cloth")
    return makeCloth(grid, seed);
  if (name == "water")
    return makeWater(grid, seed);
  if (name == "turntable")
    return makeTurntable(grid, seed);
  return nullptr;
}

} // namespace imgeo
