#pragma once
// A d-ary heap (d = 4), a priority queue. It has half the levels of a binary heap, and four small items next to each
// other fit into one cache line (LaMarca and Ladner, "The influence of caches on the performance of heaps", 1996).

#include <cstddef>
#include <utility>
#include <vector>

namespace imgeo {

/// `T` is small and has a member isBefore(const T&), a total order. The top is the first item in that order.
template <typename T> class DaryHeap {
public:
  bool empty() const { return items_.empty(); }
  const T& top() const { return items_.front(); }

  void push(T item) {
    std::size_t at = items_.size();
    items_.push_back(item);
    for (; at > 0 && item.isBefore(items_[(at - 1) / width]); at = (at - 1) / width)
      items_[at] = items_[(at - 1) / width];
    items_[at] = item;
  }

  void pop() {
    const T item = items_.back(); // replaces the top and sinks
    items_.pop_back();
    if (items_.empty())
      return;
    std::size_t at = 0;
    for (std::size_t first = 1; first < items_.size(); first = width * at + 1) {
      const std::size_t child = firstOf(first);
      if (!items_[child].isBefore(item))
        break;
      items_[at] = items_[child];
      at = child;
    }
    items_[at] = item;
  }

private:
  static constexpr std::size_t width = 4;

  /// Index of the first, in order, of the siblings that begin at index `begin`.
  std::size_t firstOf(std::size_t begin) const {
    if (begin + width <= items_.size()) { // a tournament without branches
      const std::size_t a = begin + std::size_t{items_[begin + 1].isBefore(items_[begin])},
                        b = begin + 2 + std::size_t{items_[begin + 3].isBefore(items_[begin + 2])};
      return items_[b].isBefore(items_[a]) ? b : a;
    }
    std::size_t first = begin;
    for (std::size_t i = begin + 1; i < items_.size(); ++i)
      first = items_[i].isBefore(items_[first]) ? i : first;
    return first;
  }

  std::vector<T> items_;
};

} // namespace imgeo
