#include "motions/motion.h"
#include "motions/random.h"

#include <algorithm>
#include <numbers>

namespace imgeo {

namespace {

constexpr std::uint32_t laserCount = 64;
constexpr float turnsPerSecond = 10, laserSpeed = 8, laserHeight = 2, range = 40;
constexpr float error = 0.02F; ///< of a measured distance, at most

/// A street along x: the ground, two rows of houses with gaps between them, and parked cars.
class Street {
public:
  struct Hit {
    float distance = range, reflectance = 0;
  };

  Hit trace(Vec3f from, Vec3f direction) const {
    Hit hit;
    if (direction.y < 0)
      keepNearest(hit, -from.y / direction.y, 0.25F);
    for (const float side : {-1.0F, 1.0F}) {
      const auto first = static_cast<int>(std::floor((from.x - range) / houseLength));
      const auto last = static_cast<int>(std::ceil((from.x + range) / houseLength));
      for (int house = first; house <= last; ++house) {
        const float x = static_cast<float>(house) * houseLength, tone = static_cast<float>((house % 5 + 5) % 5);
        traceBox(hit, from, direction, {x, 0, side > 0 ? 7.0F : -17.0F},
                 {x + houseLength - 3, 5 + 1.5F * tone, side > 0 ? 17.0F : -7.0F}, 0.4F + 0.1F * tone);
        traceBox(hit, from, direction, {x + 2, 0.3F, side * 4.6F - 0.9F}, {x + 6.3F, 1.5F, side * 4.6F + 0.9F}, 0.9F);
      }
    }
    return hit;
  }

private:
  static constexpr float houseLength = 14;

  static void keepNearest(Hit& hit, float distance, float reflectance) {
    if (distance > 0 && distance < hit.distance)
      hit = {distance, reflectance};
  }

  static void traceBox(Hit& hit, Vec3f from, Vec3f direction, Vec3f min, Vec3f max, float reflectance) {
    float entry = 0, exit = range;
    for (int axis = 0; axis < 3; ++axis) {
      const float inverse = 1 / (std::abs(direction[axis]) > 1e-9F ? direction[axis] : 1e-9F);
      const float a = (min[axis] - from[axis]) * inverse, b = (max[axis] - from[axis]) * inverse;
      entry = std::max(entry, std::min(a, b));
      exit = std::min(exit, std::max(a, b));
    }
    if (entry < exit)
      keepNearest(hit, entry, reflectance);
  }
};

class Turntable final : public Motion {
public:
  Turntable(std::uint32_t grid, std::uint32_t seed)
      : random_(seed), directions_(std::size_t{grid} * grid / laserCount) {
    positions_.resize(directions_ * laserCount);
    values_.resize(positions_.size());
    box_.add({-range - 1, -laserHeight - 1, -range - 1});
    box_.add({range + 1, range / 2, range + 1});
    measure(directions_);
  }

  /// Replaces the points of the directions through which the scanner has turned.
  void advance(double seconds) override {
    x_ += laserSpeed * static_cast<float>(seconds);
    turned_ += seconds * turnsPerSecond * static_cast<double>(directions_);
    const auto due = static_cast<std::size_t>(turned_);
    turned_ -= static_cast<double>(due);
    measure(std::min(due, directions_));
  }

private:
  void measure(std::size_t count) {
    for (; count > 0; --count, next_ = (next_ + 1) % directions_) {
      const float azimuth = 2 * std::numbers::pi_v<float> * static_cast<float>(next_) / static_cast<float>(directions_);
      for (std::uint32_t laser = 0; laser < laserCount; ++laser) {
        // From 2 degrees above the horizon to 25 below it.
        const float elevation =
            (2 - 27 * static_cast<float>(laser) / (laserCount - 1)) * std::numbers::pi_v<float> / 180;
        const Vec3f direction{std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                              std::cos(elevation) * std::sin(azimuth)};
        const Street::Hit hit = street_.trace({x_, laserHeight, 0}, direction);
        const std::size_t i = next_ * laserCount + laser;
        positions_[i] = direction * (hit.distance + error * random_.centred());
        values_[i] = hit.reflectance;
      }
    }
  }

  Street street_;
  Random random_;
  std::size_t directions_, next_ = 0;
  float x_ = 0;
  double turned_ = 0;
};

} // namespace

std::unique_ptr<Motion> makeTurntable(std::uint32_t grid, std::uint32_t seed) {
  return std::make_unique<Turntable>(grid, seed);
}

} // namespace imgeo
