#include "live/quantise.h"

#include "base/error.h"
#include "containers/unit_vectors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo::live {

namespace {

/// Rounds one component of every vertex to integers of `bits` bits. Double precision: positions have up to 24 bits.
std::uint64_t quantiseComponent(const float* values, std::size_t stride, double origin, double step, std::uint32_t bits,
                                double maximum, std::span<std::uint32_t> out) {
  const double factor = 1 / step;
  const double last = std::min<double>((std::uint32_t{1} << bits) - 1, std::floor((maximum - origin) * factor + 0.5));
  std::uint64_t clamped = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double value = values[i * stride];
    // A comparison with NaN is false, so it is counted and becomes 0.
    clamped += value >= origin && value <= maximum ? 0 : 1;
    const double scaled = (value - origin) * factor + 0.5;
    out[i] = static_cast<std::uint32_t>(scaled > 0 ? std::min(scaled, last) : 0);
  }
  return clamped;
}

void quantiseNormals(std::span<const float> normals, std::uint32_t bits, std::span<std::uint32_t> u,
                     std::span<std::uint32_t> v) {
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Vec3f normal{normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]};
    const float norm = length(normal);
    const Vec3f unit = norm > 0 && std::isfinite(norm) ? normal * (1 / norm) : Vec3f{0, 0, 1};
    const Vec2<std::uint32_t> encoded = octahedralFromUnit(unit, bits);
    u[i] = encoded.x;
    v[i] = encoded.y;
  }
}

void requireCount(std::span<const float> array, std::size_t count, const char* name, const std::string& location) {
  if (array.size() != count)
    throw Error(ErrorKind::usage, location, fmt::format("a frame has {} {} instead of {}", array.size(), name, count));
}

} // namespace

void checkArrays(const Arrays& arrays, const FrameLayout& layout, const std::string& location) {
  const std::size_t vertices = layout.vertices;
  requireCount(arrays.positions, 3 * vertices, "coordinates", location);
  requireCount(arrays.normals, layout.normalBits > 0 ? 3 * vertices : 0, "components of normals", location);
  requireCount(arrays.colors, layout.colorComponents * vertices, "components of colours", location);
  requireCount(arrays.values, layout.valueComponents * vertices, "values", location);
}

std::uint64_t quantise(const Arrays& arrays, const Description& description, Frame& frame) {
  const FrameLayout& layout = frame.layout = description.layout;
  frame.components.resize(std::size_t{componentCount(layout)} * layout.vertices);
  std::uint64_t clamped = 0;
  std::uint32_t component = 0;
  const auto nextComponent = [&] {
    return std::span(frame.components).subspan(std::size_t{component++} * layout.vertices, layout.vertices);
  };
  for (int axis = 0; axis < 3; ++axis)
    clamped += quantiseComponent(arrays.positions.data() + axis, 3, description.box.min[axis], description.step(),
                                 layout.positionBits, description.box.max[axis], nextComponent());
  if (layout.normalBits > 0) {
    const auto u = nextComponent(), v = nextComponent();
    quantiseNormals(arrays.normals, layout.normalBits, u, v);
  }
  for (std::uint32_t i = 0; i < layout.colorComponents; ++i)
    clamped += quantiseComponent(arrays.colors.data() + i, layout.colorComponents, 0, 1.0 / 255, 8, 1, nextComponent());
  for (std::uint32_t i = 0; i < layout.valueComponents; ++i) {
    const auto& [min, max] = description.valueRange[i];
    const double step = (max - min) / ((std::uint32_t{1} << layout.valueBits) - 1);
    clamped += quantiseComponent(arrays.values.data() + i, layout.valueComponents, min, step, layout.valueBits, max,
                                 nextComponent());
  }
  return clamped;
}

} // namespace imgeo::live
