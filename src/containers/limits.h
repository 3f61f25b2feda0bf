#pragma once
// What our readers refuse as too large. Beside these, no reader allocates more
// than the bytes at hand can stand for.

#include <cstdint>

namespace imgeo {

/// Every WebGL2 device of the last ten years holds a texture of this edge.
inline constexpr std::uint32_t maxImageEdge = 4096;

/// Deflate's best: 258 bytes out of two bits (a length and a distance code of one bit each).
inline constexpr std::uint64_t maxDeflateRatio = 1032;

/// Records that 16-bit indices name; 65535 itself is WebGL2's primitive restart.
inline constexpr std::uint32_t maxIndexedVertices = 65535;

} // namespace imgeo
