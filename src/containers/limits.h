#pragma once
// What our readers refuse as too large. Beside these, no reader allocates more
// than the bytes at hand can stand for.

#include <cstdint>

namespace imgeo {

/// The edge of a texture that every WebGL2 device holds: our writers stay within it.
inline constexpr std::uint32_t guaranteedImageEdge = 2048;

/// What WebGL2 devices of the last ten years hold: our readers take no more.
inline constexpr std::uint32_t maxImageEdge = 4096;

/// Deflate's best: 258 bytes out of two bits (a length and a distance code of one bit each).
inline constexpr std::uint64_t maxDeflateRatio = 1032;

/// Records that 16-bit indices name; 65535 itself is WebGL2's primitive restart.
inline constexpr std::uint32_t maxShortIndexedVertices = 65535;

} // namespace imgeo
