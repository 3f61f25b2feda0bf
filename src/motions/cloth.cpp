#include "motions/motion.h"
#include "motions/random.h"

#include <array>
#include <numbers>

namespace imgeo {

namespace {

constexpr float edge = 2, gravity = 9.81F;
constexpr int substeps = 8;         ///< many small steps stretch less than many iterations (Macklin et al. 2019)
constexpr float damping = 0.6F;     ///< share of the speed that is lost in a second
constexpr float airResistance = 9;  ///< acceleration by air that flows along the normal, in 1/s
constexpr float maxStretch = 1.02F; ///< of the distance to the vertex from which a column hangs
// Cloth gives way to compression: were it as stiff as against stretching, rows that are pushed together would buckle at
// the width of a cell, which shows as stripes. The folds that remain are as wide as the resistance to bending makes
// them.
constexpr float stretchStiffness = 0.4F, shearStiffness = 0.2F, compressionStiffness = 0.1F, bendResistance = 0.35F;
constexpr float innerFriction = 0.5F; ///< 0..1, each frame

/// A wind whose strength and direction change smoothly: sums of sines with random phases.
class Wind {
public:
  explicit Wind(std::uint32_t seed) {
    Random random(seed);
    for (float& phase : phases_)
      phase = 2 * std::numbers::pi_v<float> * random.unit();
  }

  void setTime(float time) {
    const float gust = 1 + 0.6F * std::sin(0.9F * time + phases_[0]) + 0.4F * std::sin(2.3F * time + phases_[1]);
    const float turn = 0.9F * std::sin(0.4F * time + phases_[3]);
    mean_ = Vec3f{std::sin(turn), 0, std::cos(turn)} * (1.4F * gust);
    ripplePhase_ = phases_[2] - 5 * time;
  }

  /// In metres per second; `across` and `down` are 0..1 over the cloth.
  Vec3f at(float across, float down) const {
    const float ripple = std::sin(7 * across + 3 * down + ripplePhase_);
    return mean_ * (1 + 0.7F * ripple) + Vec3f{0, 0.5F * ripple, 0};
  }

private:
  std::array<float, 4> phases_{};
  Vec3f mean_;
  float ripplePhase_ = 0;
};

/// The share of an edge's vector by which its ends approach each other; negative where it is shorter than at rest.
inline float correctionOf(float length, float rest, float stiffness) {
  const float strain = 1 - rest / length;
  return (strain > 0 ? stiffness : std::min(stiffness, compressionStiffness)) * strain;
}

/// One coordinate array for each axis, so that the compiler can vectorise loops over a row.
struct Coordinates {
  std::vector<float> x, y, z;
  explicit Coordinates(std::size_t count) : x(count), y(count), z(count) {}
  Vec3f at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, Vec3f value) {
    x[i] = value.x;
    y[i] = value.y;
    z[i] = value.z;
  }
};

class Cloth final : public Motion {
public:
  Cloth(std::uint32_t grid, std::uint32_t seed)
      : wind_(seed), spacing_(edge / static_cast<float>(grid - 1)), current_(std::size_t{grid} * grid),
        velocities_(current_.x.size()), before_(current_), correction_(grid) {
    columns_ = grid;
    positions_.resize(current_.x.size());
    values_.resize(positions_.size());
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      const std::size_t column = i % grid, row = i / grid;
      current_.set(i, {static_cast<float>(column) * spacing_ - edge / 2, -static_cast<float>(row) * spacing_, 0});
    }
    box_.add({-2.25, -2.75, -2.25});
    box_.add({2.25, 1.75, 2.25});
    store();
  }

  void advance(double seconds) override {
    time_ += static_cast<float>(seconds);
    wind_.setTime(time_);
    applyForces(static_cast<float>(seconds));
    smooth(velocities_, innerFriction);
    for (int i = 0; i < substeps; ++i)
      advanceBy(static_cast<float>(seconds) / substeps);
    store();
  }

private:
  /// Gravity, and the pressure of the wind: it acts along the normal, in proportion to the relative speed.
  void applyForces(float seconds) {
    const float kept = 1 - damping * seconds;
    const auto last = static_cast<float>(columns_ - 1);
    for (std::uint32_t row = 1; row < columns_; ++row)
      for (std::uint32_t column = 0; column < columns_; ++column) {
        const std::size_t i = std::size_t{row} * columns_ + column;
        const Vec3f velocity = velocities_.at(i), normal = normalAt(row, column);
        const Vec3f wind = wind_.at(static_cast<float>(column) / last, static_cast<float>(row) / last);
        const float pressure = airResistance * dot(normal, wind - velocity);
        velocities_.set(i, velocity * kept + (normal * pressure + Vec3f{0, -gravity, 0}) * seconds);
      }
  }

  /// Moves each vector towards the mean of its neighbours' by this share. It makes folds wider than the cells of the
  /// grid: of velocities it is inner friction, of positions resistance to bending.
  void smooth(Coordinates& vectors, float share) {
    for (std::vector<float>* axis : {&vectors.x, &vectors.y, &vectors.z}) {
      scratch_ = *axis;
      const std::uint32_t last = columns_ - 1;
      for (std::uint32_t row = 1; row < last; ++row) {
        const float* value = axis->data() + std::size_t{row} * columns_;
        const float *above = value - columns_, *below = value + columns_;
        float* out = scratch_.data() + std::size_t{row} * columns_;
        // Hems have neighbours only along the hem.
        for (const std::uint32_t i : {0u, last})
          out[i] = value[i] + share * ((above[i] + below[i]) / 2 - value[i]);
#pragma omp simd
        for (std::uint32_t i = 1; i < last; ++i) {
          const float neighbours = value[i - 1] + value[i + 1] + above[i] + below[i];
          out[i] = value[i] + share * (neighbours / 4 - value[i]);
        }
      }
      const float* value = axis->data() + std::size_t{last} * columns_;
      float* out = scratch_.data() + std::size_t{last} * columns_;
      for (std::uint32_t i = 1; i < last; ++i)
        out[i] = value[i] + share * ((value[i - 1] + value[i + 1]) / 2 - value[i]);
      std::swap(*axis, scratch_);
    }
  }

  void advanceBy(float step) {
    before_ = current_;
    for (std::size_t i = columns_; i < positions_.size(); ++i) {
      current_.x[i] += velocities_.x[i] * step;
      current_.y[i] += velocities_.y[i] * step;
      current_.z[i] += velocities_.z[i] * step;
    }
    satisfyConstraints();
    smooth(current_, bendResistance);
    const float rate = 1 / step;
    for (std::size_t i = columns_; i < positions_.size(); ++i) {
      velocities_.x[i] = (current_.x[i] - before_.x[i]) * rate;
      velocities_.y[i] = (current_.y[i] - before_.y[i]) * rate;
      velocities_.z[i] = (current_.z[i] - before_.z[i]) * rate;
    }
  }

  Vec3f normalAt(std::uint32_t row, std::uint32_t column) const {
    const std::size_t i = std::size_t{row} * columns_ + column;
    const Vec3f across = current_.at(column + 1 < columns_ ? i + 1 : i) - current_.at(column > 0 ? i - 1 : i);
    const Vec3f up = current_.at(i - columns_) - current_.at(row + 1 < columns_ ? i + columns_ : i);
    const Vec3f normal = cross(across, up);
    return normal * (1 / std::max(length(normal), 1e-12F));
  }

  /// Edges and diagonals of the grid keep their lengths. From the fixed row downwards, so that one pass carries the
  /// weight of every row.
  void satisfyConstraints() {
    const float diagonal = spacing_ * std::numbers::sqrt2_v<float>;
    for (std::uint32_t row = 0; row + 1 < columns_; ++row) {
      const float upperShare = row == 0 ? 0.0F : 0.5F;
      satisfyBetween(row, 0, 0, spacing_, 1, upperShare);
      satisfyBetween(row, 0, 1, diagonal, shearStiffness, upperShare);
      satisfyBetween(row, 1, 0, diagonal, shearStiffness, upperShare);
      satisfyAlong(row + 1);
      limitStretch(row + 1);
    }
  }

  /// Edges from each vertex of a row, `first` columns from its start, to one of the next row, `second` from its start.
  void satisfyBetween(std::uint32_t row, std::uint32_t first, std::uint32_t second, float rest, float stiffness,
                      float firstShare) {
    const std::size_t a = std::size_t{row} * columns_ + first, b = std::size_t{row + 1} * columns_ + second;
    float *ax = &current_.x[a], *ay = &current_.y[a], *az = &current_.z[a];
    float *bx = &current_.x[b], *by = &current_.y[b], *bz = &current_.z[b];
    const std::uint32_t count = columns_ - std::max(first, second);
#pragma omp simd
    for (std::uint32_t i = 0; i < count; ++i) {
      const float dx = bx[i] - ax[i], dy = by[i] - ay[i], dz = bz[i] - az[i];
      const float scale = correctionOf(std::sqrt(dx * dx + dy * dy + dz * dz + 1e-12F), rest, stiffness);
      const float scaleA = scale * firstShare, scaleB = scale * (1 - firstShare);
      ax[i] += dx * scaleA;
      ay[i] += dy * scaleA;
      az[i] += dz * scaleA;
      bx[i] -= dx * scaleB;
      by[i] -= dy * scaleB;
      bz[i] -= dz * scaleB;
    }
  }

  /// The edges within a row, all from the same state: each vertex moves by the mean of its two corrections.
  void satisfyAlong(std::uint32_t row) {
    const std::size_t first = std::size_t{row} * columns_;
    float *x = &current_.x[first], *y = &current_.y[first], *z = &current_.z[first];
    float *cx = correction_.x.data(), *cy = correction_.y.data(), *cz = correction_.z.data();
    const std::uint32_t count = columns_ - 1;
#pragma omp simd
    for (std::uint32_t i = 0; i < count; ++i) {
      const float dx = x[i + 1] - x[i], dy = y[i + 1] - y[i], dz = z[i + 1] - z[i];
      const float scale = correctionOf(std::sqrt(dx * dx + dy * dy + dz * dz + 1e-12F), spacing_, stretchStiffness);
      cx[i] = dx * scale;
      cy[i] = dy * scale;
      cz[i] = dz * scale;
    }
    const auto correct = [count](float* value, const float* correction) {
      value[0] += correction[0];
#pragma omp simd
      for (std::uint32_t i = 1; i < count; ++i)
        value[i] += correction[i] - correction[i - 1];
      value[count] -= correction[count - 1];
    };
    correct(x, cx);
    correct(y, cy);
    correct(z, cz);
  }

  /// Long range attachments (Kim et al. 2012): no vertex is farther from the fixed row than its column is long.
  void limitStretch(std::uint32_t row) {
    const float maxDistance = static_cast<float>(row) * spacing_ * maxStretch;
    const std::size_t first = std::size_t{row} * columns_;
    const float *ax = current_.x.data(), *ay = current_.y.data(), *az = current_.z.data();
    float *x = &current_.x[first], *y = &current_.y[first], *z = &current_.z[first];
#pragma omp simd
    for (std::uint32_t i = 0; i < columns_; ++i) {
      const float dx = x[i] - ax[i], dy = y[i] - ay[i], dz = z[i] - az[i];
      const float scale = std::min(1.0F, maxDistance / std::sqrt(dx * dx + dy * dy + dz * dz + 1e-12F));
      x[i] = ax[i] + dx * scale;
      y[i] = ay[i] + dy * scale;
      z[i] = az[i] + dz * scale;
    }
  }

  void store() {
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      positions_[i] = current_.at(i);
      values_[i] = std::min(1.0F, length(velocities_.at(i)) / 4);
    }
  }

  Wind wind_;
  float spacing_, time_ = 0;
  Coordinates current_, velocities_, before_, correction_;
  std::vector<float> scratch_;
};

} // namespace

std::unique_ptr<Motion> makeCloth(std::uint32_t grid, std::uint32_t seed) {
  return std::make_unique<Cloth>(grid, seed);
}

} // namespace imgeo
