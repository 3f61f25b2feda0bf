#pragma once
// Where the order of a patch begins. No first triangle is the best of all patches, and the bytes of a patch differ by
// up to two percent between first triangles that are neighbours: docs/decisions/compact.md, "Effort".

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo::compact {

/// The orders of a patch that an effort tries in addition to those of the effort before.
struct Search {
  std::uint32_t spread = 0;    ///< encodes orders whose first triangles divide the patch into so many parts
  std::uint32_t known = 0;     ///< of these, the parts of the effort before, which are left out
  std::uint32_t tried = 0;     ///< orders of which only the connectivity is coded, in a fraction of the time
  std::uint32_t promising = 0; ///< encodes so many of the orders tried: those that promise the fewest bytes
};

/// Appends the first triangles of the orders to encode: the spread ones, then the promising ones, best first. Their
/// number depends on the search only: small patches repeat triangle 0. `vertices` are the corners of triangles, below
/// `vertexCount`.
void appendStarts(std::vector<std::uint32_t>& starts, std::span<const std::uint32_t> vertices,
                  std::uint32_t vertexCount, const Search& search);

} // namespace imgeo::compact
