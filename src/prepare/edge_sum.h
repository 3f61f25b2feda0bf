#pragma once
// Sums of directed edges, with which borders of surfaces are compared.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace imgeo {

/// A formal sum of directed edges, in which opposite edges cancel out (the boundary operator of a simplicial
/// complex): the sum of all edges of a surface's triangles is its border.
class EdgeSum {
public:
  void add(std::uint32_t from, std::uint32_t to, int count = 1) {
    if (from != to)
      terms_.push_back({std::min(from, to), std::max(from, to), from < to ? count : -count});
  }
  template <typename IndexOf> void addTriangles(std::span<const std::uint32_t> corners, IndexOf indexOf) {
    for (std::size_t corner = 0; corner < corners.size(); corner += 3)
      for (std::size_t i = 0; i < 3; ++i)
        add(indexOf(corners[corner + i]), indexOf(corners[corner + (i + 1) % 3]));
  }

  /// Calls visit(a, b, count) for each edge whose coefficient `count`, counted from a to b, is not 0.
  template <typename Visit> void visit(Visit visit) {
    std::ranges::sort(terms_, {}, [](const Term& term) { return std::pair(term.a, term.b); });
    for (std::size_t begin = 0, end = 0; begin < terms_.size(); begin = end) {
      int count = 0;
      for (end = begin; end < terms_.size() && terms_[end].a == terms_[begin].a && terms_[end].b == terms_[begin].b;
           ++end)
        count += terms_[end].count;
      if (count != 0)
        visit(terms_[begin].a, terms_[begin].b, count);
    }
  }

private:
  struct Term {
    std::uint32_t a, b;
    int count;
  };
  std::vector<Term> terms_;
};

} // namespace imgeo
