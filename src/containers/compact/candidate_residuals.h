#pragma once
// The residuals of a vertex for all of its candidates, of which an encoder chooses one. Computes four at a time,
// without branches, which would be unpredictable: docs/decisions/compact.md.

#include "containers/compact/prediction.h"
#include "prepare/vertex_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <tuple>

namespace imgeo::compact {

/// Three coordinates in the order in which they are coded.
using Coordinates = std::array<std::int64_t, 3>;

/// The key of a residual, by which its cost is found: twice the length of its absolute value in bits, and 1 more if the
/// bit after the first is 1.
inline std::uint32_t residualKey(std::int64_t residual) {
  const auto magnitude = static_cast<std::uint32_t>(residual < 0 ? -residual : residual);
  const auto length = static_cast<std::uint32_t>(std::bit_width(magnitude));
  return length < 2 ? 2 * length : 2 * length + (magnitude >> (length - 2) & 1);
}

class CandidateResiduals {
public:
  /// Coordinates are below `limit`: the floats and doubles of this class hold all of its numbers exactly.
  static constexpr std::int64_t limit = 1 << 24;

  /// `order`: that of the axes; `maximum`: of a coordinate.
  CandidateResiduals(const Candidates& candidates, const std::array<int, 3>& order, std::int64_t maximum)
      : maximum_(static_cast<std::int32_t>(maximum)), end_((candidates.count + lanes - 1) / lanes * lanes) {
    for (std::size_t turn = 0; turn < 3; ++turn) {
      for (std::size_t i = 0; i < candidates.count; ++i)
        guesses_[turn][i] = static_cast<std::int32_t>(candidates.positions[i][order[turn]]);
      for (std::size_t i = candidates.count; i < end_; ++i)
        guesses_[turn][i] = 0;
    }
  }

  /// Computes the keys of the residuals of a coordinate off the grid.
  void setKeys(std::size_t turn, std::int64_t coordinate) {
    for (std::size_t i = 0; i < end_; i += lanes)
      write(residuals_[turn], i, keysOf(static_cast<std::int32_t>(coordinate) - clamped(read(guesses_[turn], i))));
  }

  /// The same for the last of the coordinates, which lies on a plane through the candidate.
  void setKeysOnSlope(const Coordinates& normal, const Coordinates& coordinates) {
    if (normal[2] == 0)
      return setKeys(2, coordinates[2]);
    constexpr double beyond = 1 << 28; // farther than any candidate is from the lattice
    const auto first = static_cast<double>(normal[0]), second = static_cast<double>(normal[1]),
               last = static_cast<double>(normal[2]);
    const auto at = [&](std::size_t turn) { return static_cast<std::int32_t>(coordinates[turn]); };
    for (std::size_t i = 0; i < end_; ++i) {
      const double rise = (first * (at(0) - guesses_[0][i]) + second * (at(1) - guesses_[1][i])) / last;
      const double notBelow = rise > -beyond ? rise : -beyond;
      guesses_[2][i] -= static_cast<std::int32_t>(notBelow < beyond ? notBelow : beyond);
    }
    setKeys(2, coordinates[2]);
  }

  /// Computes the steps to line `line` of the grid from the lines nearest to the candidates. Nearby lines are counted
  /// by the coordinates at which they begin to be the nearest ones, instead of by a division.
  void setSteps(std::size_t turn, const VertexGrid& grid, int axis, std::int64_t line) {
    constexpr std::int32_t near = 3;
    std::array<std::int32_t, 2 * near> begins; // of the lines after line - near
    for (std::int32_t i = 0; i < 2 * near; ++i)
      begins[i] = static_cast<std::int32_t>(
          std::clamp<std::int64_t>(firstNearestTo(grid, axis, line - near + 1 + i), -1, limit));
    for (std::size_t i = 0; i < end_; i += lanes) {
      const Integers expected = clamped(read(guesses_[turn], i));
      Integers steps = Integers{} + near;
      for (const std::int32_t begin : begins)
        steps += expected >= begin; // -1 where it is so
      write(residuals_[turn], i, steps);
    }
    for (std::size_t i = 0; i < end_; ++i)
      if (std::abs(residuals_[turn][i]) == near) [[unlikely]]
        residuals_[turn][i] =
            static_cast<std::int32_t>(line - nearestGridLine(grid, axis, std::clamp(guesses_[turn][i], 0, maximum_)));
  }

  /// The key of a residual, or a number of steps.
  std::int32_t at(std::size_t turn, std::size_t candidate) const { return residuals_[turn][candidate]; }

private:
  using Integers [[gnu::vector_size(16)]] = std::int32_t;
  using Floats [[gnu::vector_size(16)]] = float;
  static constexpr std::size_t lanes = 4;
  static constexpr std::size_t size = (std::tuple_size_v<decltype(Candidates::positions)> + lanes - 1) / lanes * lanes;
  struct alignas(16) Row : std::array<std::int32_t, size> {};

  static Integers read(const Row& row, std::size_t i) {
    Integers four;
    std::memcpy(&four, &row[i], sizeof four);
    return four;
  }
  static void write(Row& row, std::size_t i, Integers four) { std::memcpy(&row[i], &four, sizeof four); }

  /// residualKey() of four residuals: a float has the length in its exponent, followed by the bit after the first.
  static Integers keysOf(Integers residuals) {
    constexpr std::int32_t keyOfOne = 2, bitsOfOne = std::bit_cast<std::int32_t>(1.0f) >> 22;
    const Integers sizes = residuals < 0 ? -residuals : residuals;
    const auto bits = reinterpret_cast<Integers>(__builtin_convertvector(sizes, Floats));
    return ((bits >> 22) - (bitsOfOne - keyOfOne)) & (sizes > 0);
  }

  Integers clamped(Integers guesses) const {
    const Integers zero{}, maximum = zero + maximum_, notBefore = guesses > zero ? guesses : zero;
    return notBefore < maximum ? notBefore : maximum;
  }

  std::int32_t maximum_;
  std::size_t end_;
  std::array<Row, 3> guesses_, residuals_; ///< by turn; keys, or steps
};

} // namespace imgeo::compact
