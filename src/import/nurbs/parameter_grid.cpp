#include "import/nurbs/parameter_grid.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace imgeo::nurbs {

namespace {

/// Limit of the number of vertices of the grid of parameters.
constexpr std::size_t maxGridVertices = std::size_t{1} << 21;

/// The grid is refined at most this many times where the middles of its cells are too far from the surface.
constexpr int maxRefinements = 4;

/// About this many parameters of one direction are examined when the other direction is divided (samplesOf).
constexpr std::size_t maxSamples = 48;

/// Parameters at which a direction is examined: several within each interval of its knots.
std::vector<double> samplesOf(const Basis& basis) {
  const std::vector<double> breaks = basis.breaks();
  const std::size_t intervals = breaks.size() - 1;
  const std::size_t perInterval = std::clamp<std::size_t>(maxSamples / intervals, 1, basis.order);
  const std::size_t step = std::max<std::size_t>(intervals / maxSamples, 1);
  std::vector<double> samples;
  for (std::size_t i = 0; i < intervals; i += step)
    for (std::size_t j = 0; j < perInterval; ++j)
      samples.push_back(breaks[i] +
                        (breaks[i + 1] - breaks[i]) * static_cast<double>(j) / static_cast<double>(perInterval));
  samples.push_back(breaks.back());
  return samples;
}

class GridMaker {
public:
  GridMaker(const Surface& surface, const Tolerance& tolerance) : surface_(surface), tolerance_(tolerance) {}

  ParameterGrid make() {
    // Distances along both directions add up: refine() divides further where the sum is too large.
    grid_.us = parametersAlong(surface_.u, surface_.v, [&](std::size_t uSpan, std::size_t vSpan, double u, double v) {
      const SurfacePoint point = evaluate(surface_, uSpan, vSpan, u, v);
      return CurvePoint{point.point, point.alongU};
    });
    grid_.vs = parametersAlong(surface_.v, surface_.u, [&](std::size_t vSpan, std::size_t uSpan, double v, double u) {
      const SurfacePoint point = evaluate(surface_, uSpan, vSpan, u, v);
      return CurvePoint{point.point, point.alongV};
    });
    for (int i = 0; i < maxRefinements && refine(); ++i) {
    }
    return std::move(grid_);
  }

private:
  /// Parameters of one direction, so close that the curves along it, at samples of the other, keep to the tolerance.
  /// `pointAt`: the point of such a curve, from the spans of knots and the parameters of this direction and of the
  /// other.
  template <typename At>
  std::vector<double> parametersAlong(const Basis& along, const Basis& across, const At& pointAt) const {
    return subdivided(along.breaks(), [&, samples = samplesOf(across)](double begin, double end) {
      const std::size_t span = along.spanAt((begin + end) / 2);
      return std::ranges::any_of(samples, [&](double sample) {
        const std::size_t sampleSpan = across.spanAt(sample);
        return isBent([&](double t) { return pointAt(span, sampleSpan, t, sample); }, begin, end, tolerance_);
      });
    });
  }

  Vec3d at(double u, double v) const {
    return evaluate(surface_, surface_.u.spanAt(u), surface_.v.spanAt(v), u, v).point;
  }

  /// Measures the distance between surface and triangles at the middle of each cell, and divides the rows or columns of
  /// cells that are too far away, in the direction that bends more. Returns whether it divided any.
  bool refine() {
    const auto& [us, vs, error] = grid_;
    std::vector<Vec3d> points;
    for (const double v : vs)
      for (const double u : us)
        points.push_back(at(u, v));
    std::vector<double> newUs, newVs;
    double maxDistance = 0;
    std::vector<bool> dividesRow(vs.size()), dividesColumn(us.size());
    for (std::size_t row = 0; row + 1 < vs.size(); ++row)
      for (std::size_t column = 0; column + 1 < us.size(); ++column) {
        const Vec3d* const low = &points[row * us.size() + column];
        const Vec3d* const high = low + us.size();
        const double u = (us[column] + us[column + 1]) / 2, v = (vs[row] + vs[row + 1]) / 2;
        const Vec3d middle = at(u, v);
        const bool isRising = isRisingDiagonalShorter(low[0], low[1], high[1], high[0]);
        const double distance = isRising ? std::min(distanceToTriangle(middle, low[0], low[1], high[1]),
                                                    distanceToTriangle(middle, low[0], high[1], high[0]))
                                         : std::min(distanceToTriangle(middle, low[0], low[1], high[0]),
                                                    distanceToTriangle(middle, low[1], high[1], high[0]));
        const double alongU = distanceToSegment(at(u, vs[row]), low[0], low[1]),
                     alongV = distanceToSegment(at(us[column], v), low[0], high[0]);
        maxDistance = std::max({maxDistance, distance, alongU, alongV});
        if (distance > tolerance_.distance)
          (alongU > alongV ? dividesColumn[column] : dividesRow[row]) = true;
      }
    grid_.error = maxDistance;
    const std::vector<double> finerUs = divided(us, dividesColumn), finerVs = divided(vs, dividesRow);
    const bool isFiner = finerUs.size() + finerVs.size() > us.size() + vs.size();
    if (!isFiner || finerUs.size() * finerVs.size() > maxGridVertices)
      return false;
    grid_.us = finerUs;
    grid_.vs = finerVs;
    return true;
  }

  static std::vector<double> divided(const std::vector<double>& values, const std::vector<bool>& divides) {
    std::vector<double> finer;
    for (std::size_t i = 0; i < values.size(); ++i) {
      finer.push_back(values[i]);
      if (i + 1 < values.size() && divides[i])
        finer.push_back((values[i] + values[i + 1]) / 2);
    }
    return finer;
  }

  const Surface& surface_;
  Tolerance tolerance_;
  ParameterGrid grid_;
};

} // namespace

bool isRisingDiagonalShorter(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  return length(c - a) <= length(d - b);
}

ParameterGrid parameterGridOf(const Surface& surface, const Tolerance& tolerance) {
  return GridMaker(surface, tolerance).make();
}

} // namespace imgeo::nurbs
