#include "import/nurbs/basis.h"

#include <algorithm>
#include <cassert>

namespace imgeo::nurbs {

std::size_t Basis::spanAt(double t) const {
  const auto first = knots.begin() + static_cast<std::ptrdiff_t>(degree());
  const auto last = knots.begin() + static_cast<std::ptrdiff_t>(controlPoints());
  auto after = std::upper_bound(first, last, t);
  if (after == last) // at the end, or beyond: the last interval that is not empty
    after = std::lower_bound(first, last, *last);
  if (after == first)
    ++after;
  return static_cast<std::size_t>(after - knots.begin()) - 1;
}

std::vector<double> Basis::breaks() const {
  std::vector<double> breaks;
  for (std::size_t i = degree(); i <= controlPoints(); ++i)
    if (breaks.empty() || knots[i] > breaks.back())
      breaks.push_back(knots[i]);
  return breaks;
}

bool Basis::mayHaveCorner(double knot) const {
  return knot > begin() && knot < end() && static_cast<std::size_t>(std::ranges::count(knots, knot)) >= degree();
}

BasisValues evaluate(const Basis& basis, std::size_t span, double t) {
  assert(basis.order <= maxOrder);
  const std::vector<double>& knots = basis.knots;
  BasisValues values;
  std::array<double, maxOrder> left{}, right{};
  values.value[0] = 1;
  for (std::size_t degree = 1; degree < basis.order; ++degree) {
    left[degree] = t - knots[span + 1 - degree];
    right[degree] = knots[span + degree] - t;
    const bool isLast = degree + 1 == basis.order;
    double saved = 0;
    if (isLast)
      values.derivative = {};
    for (std::size_t i = 0; i < degree; ++i) {
      const double quotient = values.value[i] / (right[i + 1] + left[degree - i]);
      if (isLast) { // the derivative is a difference of functions of the degree below
        values.derivative[i] -= static_cast<double>(degree) * quotient;
        values.derivative[i + 1] += static_cast<double>(degree) * quotient;
      }
      values.value[i] = saved + right[i + 1] * quotient;
      saved = left[degree - i] * quotient;
    }
    values.value[degree] = saved;
  }
  return values;
}

std::vector<double> clampedKnots(std::size_t order, std::size_t controlPoints) {
  std::vector<double> knots(order, 0.0);
  const std::size_t intervals = controlPoints - order + 1;
  for (std::size_t i = 1; i < intervals; ++i)
    knots.push_back(static_cast<double>(i) / static_cast<double>(intervals));
  knots.insert(knots.end(), order, 1.0);
  return knots;
}

bool areValidKnots(std::span<const double> knots, std::size_t order, std::size_t controlPoints) {
  return order >= 2 && order <= maxOrder && controlPoints >= order && knots.size() == controlPoints + order &&
         std::ranges::is_sorted(knots) && knots[order - 1] < knots[controlPoints];
}

} // namespace imgeo::nurbs
