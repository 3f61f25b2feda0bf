#pragma once
// For tests: frames of every kind.

#include "live/frame.h"

#include <random>

namespace imgeo::live::testing {

/// The standard's distributions differ between libraries; its engines do not.
class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t operator()() { return static_cast<std::uint32_t>(engine_()); }

private:
  std::mt19937 engine_;
};

/// Integers that change smoothly along rows and columns, with a little noise.
inline Frame smoothFrame(const FrameLayout& layout, std::uint32_t seed) {
  Frame frame{layout, 1'000'000 + seed, 1'000'000, 0.25 * seed, {}};
  Random random(seed);
  const std::uint32_t columns = layout.columns > 0 ? layout.columns : layout.vertices;
  for (const ComponentBits& attribute : attributesOf(layout))
    for (std::uint32_t component = 0; component < attribute.count; ++component) {
      const std::uint32_t mask = (1u << attribute.bits) - 1, slopeX = random() % 40, slopeY = random() % 40;
      const std::uint32_t start = random();
      for (std::uint32_t i = 0; i < layout.vertices; ++i)
        frame.components.push_back((start + slopeX * (i % columns) + slopeY * (i / columns) + random() % 5) & mask);
    }
  return frame;
}

/// Integers without any order.
inline Frame noiseFrame(const FrameLayout& layout, std::uint32_t seed) {
  Frame frame = smoothFrame(layout, seed);
  Random random(seed);
  for (const ComponentBits& attribute : attributesOf(layout))
    for (std::size_t i = std::size_t{attribute.first} * layout.vertices;
         i < std::size_t{attribute.first + attribute.count} * layout.vertices; ++i)
      frame.components[i] = random() & ((1u << attribute.bits) - 1);
  return frame;
}

struct FrameSample {
  std::string name;
  Frame frame;
  Prediction prediction;
};

/// The frames of vectors/frame-1.
inline std::vector<FrameSample> frameSamples() {
  const FrameLayout grid{35, 7}, row{9, 9}, points{40, 0};
  Frame last = smoothFrame({4, 2}, 9);
  last.number = last.epoch = maxFrameNumber;
  last.time = -1.5;
  return {
      {"one-vertex", smoothFrame({1, 0}, 1), Prediction::none},
      {"grid", smoothFrame(grid, 2), Prediction::planar},
      {"grid-of-one-row", smoothFrame(row, 3), Prediction::planar},
      {"grid-of-one-column", smoothFrame({9, 1}, 4), Prediction::planar},
      {"grid-linear", smoothFrame(grid, 5), Prediction::linear},
      {"points-none", smoothFrame(points, 6), Prediction::none},
      {"points-previous", smoothFrame(points, 7), Prediction::previous},
      {"points-linear", smoothFrame(points, 8), Prediction::linear},
      {"last-number", last, Prediction::planar},
      {"noise", noiseFrame(grid, 10), Prediction::planar},
      {"bits-8", smoothFrame({35, 7, 8}, 11), Prediction::planar},
      {"bits-11", noiseFrame({35, 7, 11}, 12), Prediction::planar},
      {"bits-17", noiseFrame({35, 7, 17}, 13), Prediction::previous},
      {"bits-24", noiseFrame({35, 7, 24}, 14), Prediction::linear},
      {"normals", smoothFrame({35, 7, 16, 8}, 15), Prediction::planar},
      {"colors", smoothFrame({35, 0, 16, 0, 3}, 16), Prediction::previous},
      {"values", smoothFrame({35, 0, 16, 0, 0, 1, 12}, 17), Prediction::linear},
      {"all-attributes", noiseFrame({36, 6, 20, 13, 4, 4, 24}, 18), Prediction::planar},
  };
}

} // namespace imgeo::live::testing
