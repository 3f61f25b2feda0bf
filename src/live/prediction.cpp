#include "live/prediction.h"

namespace imgeo::live {

namespace {

std::uint32_t maskOf(std::uint32_t bits) {
  return (std::uint32_t{1} << bits) - 1;
}

/// The difference modulo 2^bits as the nearest signed number, with the sign in the lowest bit.
class Folding {
public:
  explicit Folding(std::uint32_t bits) : shift_(32 - bits) {}

  std::uint32_t operator()(std::uint32_t value, std::uint32_t prediction) const {
    const auto difference = static_cast<std::int32_t>((value - prediction) << shift_) >> shift_;
    return (static_cast<std::uint32_t>(difference) << 1) ^ static_cast<std::uint32_t>(difference >> 31);
  }

private:
  std::uint32_t shift_;
};

std::uint32_t unfold(std::uint32_t residual) {
  return (residual >> 1) ^ (0 - (residual & 1));
}

} // namespace

void residualsOf(std::span<const std::uint32_t> values, Prediction prediction, std::uint32_t columns,
                 std::uint32_t bits, std::span<std::uint32_t> residuals) {
  const std::size_t count = values.size();
  const std::uint32_t* v = values.data();
  std::uint32_t* r = residuals.data();
  const Folding fold(bits);
  switch (prediction) {
  case Prediction::none:
    for (std::size_t i = 0; i < count; ++i)
      r[i] = fold(v[i], 0);
    return;
  case Prediction::previous:
    r[0] = fold(v[0], 0);
    for (std::size_t i = 1; i < count; ++i)
      r[i] = fold(v[i], v[i - 1]);
    return;
  case Prediction::linear:
    r[0] = fold(v[0], 0);
    if (count > 1)
      r[1] = fold(v[1], v[0]);
    for (std::size_t i = 2; i < count; ++i)
      r[i] = fold(v[i], 2 * v[i - 1] - v[i - 2]);
    return;
  case Prediction::planar:
    r[0] = fold(v[0], 0);
    for (std::size_t i = 1; i < columns; ++i)
      r[i] = fold(v[i], v[i - 1]);
    for (std::size_t row = columns; row < count; row += columns) {
      r[row] = fold(v[row], v[row - columns]);
      for (std::size_t i = row + 1; i < row + columns; ++i)
        r[i] = fold(v[i], v[i - 1] + v[i - columns] - v[i - columns - 1]);
    }
    return;
  }
}

void restoreValues(std::span<std::uint32_t> residuals, Prediction prediction, std::uint32_t columns,
                   std::uint32_t bits) {
  const std::size_t count = residuals.size();
  std::uint32_t* v = residuals.data();
  const std::uint32_t mask = maskOf(bits);
  switch (prediction) {
  case Prediction::none:
    for (std::size_t i = 0; i < count; ++i)
      v[i] = unfold(v[i]) & mask;
    return;
  case Prediction::previous:
    v[0] = unfold(v[0]) & mask;
    for (std::size_t i = 1; i < count; ++i)
      v[i] = (v[i - 1] + unfold(v[i])) & mask;
    return;
  case Prediction::linear:
    v[0] = unfold(v[0]) & mask;
    if (count > 1)
      v[1] = (v[0] + unfold(v[1])) & mask;
    for (std::size_t i = 2; i < count; ++i)
      v[i] = (2 * v[i - 1] - v[i - 2] + unfold(v[i])) & mask;
    return;
  case Prediction::planar:
    v[0] = unfold(v[0]) & mask;
    for (std::size_t i = 1; i < columns; ++i)
      v[i] = (v[i - 1] + unfold(v[i])) & mask;
    for (std::size_t row = columns; row < count; row += columns) {
      v[row] = (v[row - columns] + unfold(v[row])) & mask;
      for (std::size_t i = row + 1; i < row + columns; ++i)
        v[i] = (v[i - 1] + v[i - columns] - v[i - columns - 1] + unfold(v[i])) & mask;
    }
    return;
  }
}

} // namespace imgeo::live
