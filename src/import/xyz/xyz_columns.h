#pragma once
// What the numbers of points as text are: by a line of their names, or else by their values. No standard says it.

#include "base/bytes.h"
#include "import/text/number_lines.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

struct XyzColumns {
  using Triple = std::array<std::size_t, 3>;
  struct Value {
    std::size_t column = 0;
    std::string name;
  };

  std::size_t count = 0; ///< numbers of a point
  std::size_t begin = 0; ///< the byte of the first point's line
  Triple position{0, 1, 2};
  std::optional<Triple> normal, color;
  double white = 255;        ///< the largest number of a colour's channel: 1, 255 or 65,535
  std::vector<Value> values; ///< what else a point has, in the order of the columns
};

/// The most numbers of a point.
inline constexpr std::size_t maxXyzNumbers = 64;

/// The columns of a text. The line before the first point has names where it has as many words as a point has numbers,
/// and some of these names or, in a table, commas or semicolons; # or // may precede it. Names are compared in any
/// case: x, y, z; r, g, b or red, green, blue; nx, ny, nz; others are those of further values. Without x, y, z the
/// first three numbers are the position. Without names, the first thousand points decide: three numbers that follow one
/// another are a normal if its length is 1, and a colour if they are integers up to 255 or all within 0 ... 1; a single
/// number that is left, behind the position or at the end, is an intensity. Throws Error{malformed} where there is no
/// point, or where these points have different or fewer than three numbers.
XyzColumns xyzColumnsOf(ByteSpan text, const std::string& name);

/// The numbers of a point, until the next call. Throws Error{malformed} where there are not `count` numbers.
std::span<const double> xyzNumbers(NumberLines& lines, std::size_t count);

} // namespace imgeo
