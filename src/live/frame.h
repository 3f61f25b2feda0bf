#pragma once
// A frame of a live stream: the vertices of one moment. docs/formats/frame.md specifies every byte.

#include "base/bytes.h"

#include <span>
#include <string>
#include <vector>

namespace imgeo::live {

constexpr std::uint32_t maxFrameVertices = std::uint32_t{1} << 22;
constexpr std::size_t maxUnpackedBytes = std::size_t{1} << 26;
constexpr std::size_t frameHeaderBytes = 52;
/// The bit that marks a difference in the byte with the prediction, in frames of sequences.
constexpr std::uint8_t differenceBit = 4;
/// Largest frame number: the largest integer that JavaScript counts exactly.
constexpr std::uint64_t maxFrameNumber = (std::uint64_t{1} << 53) - 1;

/// What all frames of an epoch have in common.
struct FrameLayout {
  std::uint32_t vertices = 0;        ///< 1 .. maxFrameVertices
  std::uint32_t columns = 0;         ///< vertices in a row of the grid; 0: the vertices are no grid
  std::uint32_t positionBits = 16;   ///< 8..24
  std::uint32_t normalBits = 0;      ///< 8..16 for each of two octahedral numbers; 0: no normals
  std::uint32_t colorComponents = 0; ///< 3 or 4 of 8 bits; 0: no colours
  std::uint32_t valueComponents = 0; ///< 1..4; 0: no values
  std::uint32_t valueBits = 0;       ///< 8..24; 0 where there are no values

  friend bool operator==(const FrameLayout&, const FrameLayout&) = default;
};

/// How a vertex is predicted from the vertices before it.
enum class Prediction : std::uint8_t { none = 0, previous = 1, linear = 2, planar = 3 };

struct FrameHeader {
  FrameLayout layout;
  std::uint64_t number = 0; ///< 0 .. maxFrameNumber
  std::uint64_t epoch = 0;  ///< number of the epoch's first frame, at most `number`
  double time = 0;          ///< in seconds, finite
  Prediction prediction = Prediction::none;
  bool isDifference = false;     ///< its integers are differences to those of the frame before: only in sequences
  std::uint32_t packedBytes = 0; ///< length of the gzip stream behind the header
};

/// Where a frame is read from. Frames of sequences (docs/formats/sequence.md) may be differences.
enum class FrameContext : std::uint8_t { stream, sequence };

/// Components of a vertex, in their order: x y z, then those of normal, colour and values that the layout has.
struct ComponentBits {
  std::uint32_t first = 0, count = 0; ///< components of one attribute
  std::uint32_t bits = 0;             ///< of each
};
std::vector<ComponentBits> attributesOf(const FrameLayout& layout);
std::uint32_t componentCount(const FrameLayout& layout);
/// Bytes of the planes of a frame before they are packed.
std::uint64_t unpackedBytesOf(const FrameLayout& layout);

/// Throws Error{malformed, limit} with `location` unless the layout is one that frames may have.
void checkLayout(const FrameLayout& layout, const std::string& location);

/// The stored integers of all vertices: component c of vertex i is components[c * vertices + i], less than 2^bits.
struct Frame {
  FrameLayout layout;
  std::uint64_t number = 0, epoch = 0;
  double time = 0;
  std::vector<std::uint32_t> components;

  std::span<const std::uint32_t> component(std::uint32_t index) const {
    return {components.data() + std::size_t{index} * layout.vertices, layout.vertices};
  }
  friend bool operator==(const Frame&, const Frame&) = default;
};

/// The prediction that encodeFrame() chooses: planar on a grid, otherwise the one with the smallest residuals.
Prediction choosePrediction(const Frame& frame);

/// Deflate's level. Higher ones save 1 to 6 % of the bytes for two to ten times the time (docs/formats/frame.md,
/// "Choices").
constexpr int liveCompressionLevel = 1;

/// The bytes of a frame. The layout is valid, every integer is less than 2^bits. Deterministic; equal values may have
/// different bytes with another prediction.
Bytes encodeFrame(const Frame& frame, Prediction prediction, int compressionLevel = liveCompressionLevel);
Bytes encodeFrame(const Frame& frame);

/// The bytes of a frame as its difference to the frame before, which has the same layout. For sequences.
Bytes encodeDifference(const Frame& frame, const Frame& before, Prediction prediction, int compressionLevel);

/// Reads and checks the header and the length of a frame, without unpacking it. Safe for untrusted bytes. Throws
/// Error{truncated, malformed, unsupported, limit} with `location`.
FrameHeader readFrameHeader(ByteSpan bytes, const std::string& location, FrameContext context = FrameContext::stream);

/// Reads a frame. Safe for untrusted bytes; allocates at most 5 * 1032 bytes for each of them. Throws like
/// readFrameHeader().
Frame decodeFrame(ByteSpan bytes, const std::string& location);

/// Reads a frame of a sequence. `before`: the frame before it; nullptr: there is none, and a difference is malformed.
Frame decodeFrame(ByteSpan bytes, const Frame* before, const std::string& location);

} // namespace imgeo::live
