#pragma once
// The index of a sequence: recorded frames of one topology in files of about a second each. docs/formats/sequence.md
// specifies it.

#include "live/description.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

inline constexpr std::uint32_t maxSequenceFrames = 1 << 20;
inline constexpr std::uint32_t maxSequenceFileFrames = 1024;
inline constexpr std::uint64_t maxSequenceFileBytes = std::uint64_t{1} << 28;
inline constexpr std::size_t maxSequenceIndexBytes = std::size_t{1} << 22;

/// A file of frames, which begins with a key frame.
struct SequenceFile {
  std::string url; ///< beside the index: letters, digits and . _ -
  std::uint32_t frames = 0;
  std::uint64_t bytes = 0;
  friend bool operator==(const SequenceFile&, const SequenceFile&) = default;
};

struct SequenceIndex {
  live::Description description; ///< `rate` is above 0; `box` holds all frames
  std::vector<SequenceFile> files;
  std::string valueName = {}; ///< the further attribute that the frames' values are, if they have any

  /// The number of all frames.
  std::uint32_t frameCount() const;
  /// The number of the first frame of a file.
  std::uint32_t firstFrameOf(std::size_t file) const;
  /// The file that holds a frame.
  std::size_t fileOf(std::uint32_t frame) const;
  double seconds() const { return frameCount() / description.rate; }

  friend bool operator==(const SequenceIndex&, const SequenceIndex&) = default;
};

/// The index as JSON.
std::string writeSequenceIndex(const SequenceIndex& index);

/// Reads an index. Safe for untrusted text. Throws Error{malformed, unsupported, limit} with `location`.
SequenceIndex readSequenceIndex(std::string_view json, const std::string& location);

} // namespace imgeo
