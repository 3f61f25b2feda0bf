#pragma once
// B-spline basis functions (Piegl & Tiller, "The NURBS Book", 1997, chapter 2).

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace imgeo::nurbs {

/// Limit of the order: the degree plus 1.
inline constexpr std::size_t maxOrder = 32;

/// The basis functions along one parameter: `knots` are non-decreasing, order more than there are control points, and
/// the domain, from knot order - 1 to the order-th last, is not empty.
struct Basis {
  std::size_t order = 2;
  std::vector<double> knots;

  std::size_t controlPoints() const { return knots.size() - order; }
  std::size_t degree() const { return order - 1; }
  double begin() const { return knots[degree()]; }
  double end() const { return knots[controlPoints()]; }
  /// The index i of the knot interval [knots[i], knots[i + 1]), not empty and inside the domain, that contains t; the
  /// nearest one for a t outside of the domain.
  std::size_t spanAt(double t) const;
  /// The distinct knots of the domain, its ends included, in ascending order.
  std::vector<double> breaks() const;
  /// Whether the curve may have a corner at this knot inside of the domain: derivatives are continuous up to degree
  /// minus multiplicity.
  bool mayHaveCorner(double knot) const;
};

/// Values and first derivatives of the basis functions span - degree .. span at t.
struct BasisValues {
  std::array<double, maxOrder> value{}, derivative{};
};

/// Evaluates by the recursion of Cox and de Boor. t may lie outside of the span, whose polynomials are continued.
BasisValues evaluate(const Basis& basis, std::size_t span, double t);

/// Uniform knots with `order` equal knots at each end, so that curves begin and end in control points.
std::vector<double> clampedKnots(std::size_t order, std::size_t controlPoints);

/// Whether `knots` fulfil what Basis requires.
bool areValidKnots(std::span<const double> knots, std::size_t order, std::size_t controlPoints);

} // namespace imgeo::nurbs
