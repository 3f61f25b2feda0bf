#include "prepare/source_lattice.h"

#include "base/shortest_decimal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

constexpr std::size_t minPositions = 256;

/// Positions that the step is estimated from; all are checked afterwards.
constexpr std::size_t sampleSize = 4096;

/// The largest distance of a position from its lattice point, in steps. Of positions on no lattice, one in ten lies so
/// near to a point by chance.
constexpr double nearPoint = 0.05;

/// Distances of sampled positions from the first along an axis, ascending and without repetitions.
std::vector<double> sampledOffsets(std::span<const Vec3f> positions, int axis) {
  const std::size_t stride = std::max<std::size_t>(positions.size() / sampleSize, 1);
  std::vector<double> offsets;
  for (std::size_t i = 0; i < positions.size(); i += stride)
    offsets.push_back(positions[i][axis]);
  std::ranges::sort(offsets);
  offsets.erase(std::ranges::unique(offsets).begin(), offsets.end());
  for (std::size_t i = offsets.size(); i-- > 0;)
    offsets[i] -= offsets[0];
  return offsets;
}

/// The largest step of which all gaps between offsets are multiples (Euclid's algorithm on inexact numbers); nothing
/// if it is below `minStep`. `rounding` is the error of an offset; gaps below a quarter of `minStep` are errors of
/// points.
std::optional<double> commonStep(const std::array<std::vector<double>, 3>& offsets, double minStep, double rounding) {
  std::vector<double> gaps;
  for (const std::vector<double>& ofAxis : offsets)
    for (std::size_t i = 1; i < ofAxis.size(); ++i)
      if (const double gap = ofAxis[i] - ofAxis[i - 1]; gap > 2 * rounding + minStep / 4)
        gaps.push_back(gap);
  double step = 0, largestCount = 1;
  const auto isZero = [&](double rest) { return rest <= 2 * rounding + std::min(nearPoint * step, minStep / 4); };
  // Most positions are on no lattice, which a few gaps tell.
  const std::size_t sortedFirst = std::min<std::size_t>(256, gaps.size());
  std::partial_sort(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(sortedFirst), gaps.end());
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (i == sortedFirst)
      std::sort(gaps.begin() + static_cast<std::ptrdiff_t>(i), gaps.end());
    double gap = gaps[i];
    while (step > 0 && !isZero(gap)) {
      const double rest = std::abs(std::remainder(gap, step));
      if (isZero(rest)) {
        // Longer gaps tell the step more precisely.
        if (const double count = std::round(gap / step); count > largestCount) {
          largestCount = count;
          step = gap / count;
        }
        break;
      }
      gap = std::exchange(step, rest);
      largestCount = 1;
    }
    if (step == 0)
      step = gap;
    if (step < minStep)
      return std::nullopt;
  }
  return step > 0 ? std::optional(step) : std::nullopt;
}

/// A better estimate of a step, from small offsets to large ones: the error of the estimate shrinks as they grow.
/// Nothing if an offset is no multiple of it.
std::optional<double> refinedStep(const std::array<std::vector<double>, 3>& offsets, double step, double rounding) {
  double largest = 0;
  for (const std::vector<double>& ofAxis : offsets)
    for (const double offset : ofAxis) {
      const double count = std::round(offset / step);
      if (std::abs(offset - count * step) > 2 * rounding + nearPoint * step)
        return std::nullopt;
      if (count > largest) {
        largest = count;
        step = offset / count;
      }
    }
  return step;
}

/// The steps of a lattice along the longest edge of the box.
double stepsOf(const Lattice& lattice, const Lattice& requested) {
  return std::round(requested.step * requested.maximum() / lattice.step);
}

} // namespace

void LatticeResiduals::add(const LatticeResiduals& others) {
  for (int axis = 0; axis < 3; ++axis) {
    min[axis] = std::min(min[axis], others.min[axis]);
    max[axis] = std::max(max[axis], others.max[axis]);
  }
}

double LatticeResiduals::largest() const {
  return std::max({max.x, max.y, max.z, -min.x, -min.y, -min.z});
}

LatticeResiduals residualsOn(std::span<const Vec3f> positions, const Lattice& lattice) {
  LatticeResiduals residuals;
  for (const Vec3f& position : positions)
    for (int axis = 0; axis < 3; ++axis) {
      const double residual = std::remainder(position[axis] - lattice.origin[axis], lattice.step);
      residuals.min[axis] = std::min(residuals.min[axis], residual);
      residuals.max[axis] = std::max(residuals.max[axis], residual);
    }
  return residuals;
}

std::optional<Lattice> guessSourceLattice(std::span<const Vec3f> sample, const Lattice& requested) {
  if (sample.size() < minPositions)
    return std::nullopt;
  std::array<std::vector<double>, 3> offsets;
  double largest = 0; // absolute coordinate
  for (int axis = 0; axis < 3; ++axis) {
    offsets[static_cast<std::size_t>(axis)] = sampledOffsets(sample, axis);
    const double low = requested.origin[axis];
    largest = std::max({largest, std::abs(low), std::abs(low + requested.step * requested.maximum())});
  }
  const double rounding = largest * std::numeric_limits<float>::epsilon() / 2;
  std::optional<double> step = commonStep(offsets, requested.step, rounding);
  if (step)
    step = refinedStep(offsets, *step, rounding);
  if (!step || *step < requested.step)
    return std::nullopt;
  Lattice lattice{requested.origin, *step, 8, {1, 1, 1}};
  while (lattice.maximum() < stepsOf(lattice, requested))
    ++lattice.bits;
  return lattice;
}

Lattice centeredLattice(const Lattice& guess, const LatticeResiduals& residuals, const Lattice& requested) {
  const double tolerance = requested.step / 1024;
  Lattice lattice = guess;
  lattice.step = shortestWithin(guess.step, tolerance / stepsOf(guess, requested));
  for (int axis = 0; axis < 3; ++axis)
    lattice.origin[axis] =
        shortestWithin(guess.origin[axis] + (residuals.min[axis] + residuals.max[axis]) / 2, tolerance);
  return lattice;
}

std::optional<SourceLattice> acceptedLattice(const Lattice& centered, const LatticeResiduals& residuals,
                                             const Lattice& requested) {
  const double error = residuals.largest();
  if (error > std::min(nearPoint * centered.step, requested.step / 2))
    return std::nullopt;
  return SourceLattice{centered, error};
}

std::optional<SourceLattice> findSourceLattice(std::span<const Vec3f> sample, std::span<const Vec3f> positions,
                                               const Lattice& requested) {
  const std::optional<Lattice> guess = guessSourceLattice(sample, requested);
  if (!guess)
    return std::nullopt;
  const Lattice centered = centeredLattice(*guess, residualsOn(positions, *guess), requested);
  return acceptedLattice(centered, residualsOn(positions, centered), requested);
}

} // namespace imgeo
