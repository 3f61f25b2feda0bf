#pragma once
// What vertices with normals take before any compression, as Table 1 of the 2012
// paper counts it: typed arrays of single precision, and images of 16-bit
// positions without their padding.

#include <cstdint>

namespace imgeo {

struct RawSize {
  std::uint64_t bg = 0;  ///< 6 floats a vertex, 16 bits an index
  std::uint64_t sig = 0; ///< 6 bytes of position and 3 of normal a vertex, 16 bits an index
  friend bool operator==(const RawSize&, const RawSize&) = default;
};

/// `indexCount` is 0 where vertices are drawn in order.
constexpr RawSize rawSize(std::uint64_t vertexCount, std::uint64_t indexCount) {
  return {vertexCount * 24 + indexCount * 2, vertexCount * 9 + indexCount * 2};
}

} // namespace imgeo
