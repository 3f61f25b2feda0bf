#include "prepare/strips.h"

#include "prepare/dual_graph.h"

#include <cassert>

namespace imgeo {

namespace {

class Stripifier {
public:
  explicit Stripifier(std::span<const std::uint32_t> corners)
      : corners_(corners), across_(sidesAcross(corners)), taken_(corners.size() / 3),
        seen_(corners.size() / 3) {}

  std::vector<std::uint32_t> run() {
    for (std::uint32_t triangle = 0; triangle < taken_.size(); ++triangle) {
      const std::uint32_t* c = &corners_[3 * std::size_t{triangle}];
      if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
        taken_[triangle] = true;
    }
    for (std::uint32_t triangle = 0; triangle < taken_.size(); ++triangle)
      if (!taken_[triangle])
        emit(longestFrom(triangle));
    return std::move(strip_);
  }

private:
  /// The strip that leaves through `side`, turning as stated and then to and
  /// fro: the side by which it leaves, or would leave, each triangle.
  std::vector<std::uint32_t> walk(std::uint32_t side, bool left) {
    ++round_;
    std::vector<std::uint32_t> path;
    for (;;) {
      seen_[side / 3] = round_;
      path.push_back(side);
      const std::uint32_t entered = across_[side];
      if (entered == noSide || taken_[entered / 3] || seen_[entered / 3] == round_)
        return path;
      side = left ? sideAfter(entered) : sideBefore(entered);
      left = !left;
    }
  }

  std::vector<std::uint32_t> longestFrom(std::uint32_t triangle) {
    std::vector<std::uint32_t> best;
    for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
      for (const bool left : {false, true}) {
        std::vector<std::uint32_t> found = walk(side, left);
        if (found.size() > best.size())
          best = std::move(found);
      }
    return best;
  }

  void emit(const std::vector<std::uint32_t>& path) {
    for (const std::uint32_t side : path)
      taken_[side / 3] = true;
    // The corner opposite the first side goes first.
    const std::uint32_t first = corners_[sideBefore(path[0])];
    if (!strip_.empty())
      strip_.insert(strip_.end(), {strip_.back(), first});
    const bool odd = strip_.size() % 2 == 1;
    const std::uint32_t from = corners_[path[0]], to = corners_[sideAfter(path[0])];
    strip_.insert(strip_.end(), {first, odd ? to : from, odd ? from : to});
    for (std::size_t i = 1; i < path.size(); ++i) {
      const std::uint32_t entered = across_[path[i - 1]];
      const std::uint32_t kept =
          path[i] == sideAfter(entered) ? corners_[sideAfter(entered)] : corners_[entered];
      // A triangle left by the edge of the older vertex needs that vertex again.
      if (strip_.back() != kept)
        strip_.push_back(kept);
      strip_.push_back(corners_[sideBefore(entered)]);
    }
  }

  std::span<const std::uint32_t> corners_;
  std::vector<std::uint32_t> across_;
  std::vector<bool> taken_;         ///< by triangle: in a strip already, or degenerate
  std::vector<std::uint32_t> seen_; ///< by triangle: the last walk that passed
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> strip_;
};

} // namespace

std::vector<std::uint32_t> stitchedStrip(std::span<const std::uint32_t> corners) {
  return Stripifier(corners).run();
}

} // namespace imgeo
