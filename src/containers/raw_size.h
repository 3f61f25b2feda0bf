#pragma once
// Uncompressed size of vertices with normals, as Table 1 of the 2012 paper counts it: typed arrays in single precision,
// and images of 16-bit positions without padding.

#include <cstdint>

namespace imgeo {

struct RawSize {
  std::uint64_t bg = 0;  ///< 6 floats per vertex, 16 bits per index
  std::uint64_t sig = 0; ///< 6 bytes of position and 3 of normal per vertex, 16 bits per index
  friend bool operator==(const RawSize&, const RawSize&) = default;
};

/// `indexCount` is 0 if vertices are drawn in order.
constexpr RawSize rawSize(std::uint64_t vertexCount, std::uint64_t indexCount) {
  return {vertexCount * 24 + indexCount * 2, vertexCount * 9 + indexCount * 2};
}

} // namespace imgeo
