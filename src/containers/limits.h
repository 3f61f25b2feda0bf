#pragma once
// Limits that encoders keep and readers check. With them no reader allocates more memory than its input bytes can
// stand for.

#include <cstdint>

namespace imgeo {

/// The largest texture edge that every WebGL 2 device supports: encoders stay within it.
inline constexpr std::uint32_t guaranteedImageEdge = 2048;

/// The largest image edge that readers accept: WebGL 2 devices of the last ten years support it.
inline constexpr std::uint32_t maxImageEdge = 4096;

/// Columns and rows of a height map of several images: its lattice counts them with 16 bits.
inline constexpr std::uint32_t maxHeightMapEdge = 65536;

/// Maximum compression ratio of deflate: 258 bytes for two bits (a length and a distance code of one bit each).
inline constexpr std::uint64_t maxDeflateRatio = 1032;

/// Maximum number of vertices with 16-bit indices; index 65535 is WebGL 2's primitive restart.
inline constexpr std::uint32_t maxShortIndexedVertices = 65535;

} // namespace imgeo
