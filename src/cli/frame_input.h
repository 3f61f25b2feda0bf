#pragma once
// The frames that `imgeo publish` reads from standard input or from files: raw floats, or PLY files one behind the
// other.

#include "import/ply/frames.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo::cli {

/// What a frame has beside positions.
struct FrameContent {
  std::uint32_t vertices = 0; ///< 0: the first frame tells, which only PLY files do
  bool hasNormals = false;
  std::uint32_t colorComponents = 0; ///< 0, 3 or 4
  std::uint32_t valueComponents = 0;
  std::string attribute; ///< of PLY files: the property that has the values
};

/// The arrays of a frame, as Publisher::publish() takes them.
struct FrameArrays {
  std::vector<float> positions, normals, colors, values;
};

/// Reads the frames of one input. Its bytes say which kind they are: PLY files begin with "ply".
class FrameInput {
public:
  /// `file`: "-" for standard input. Throws Error{io} if it cannot be opened.
  explicit FrameInput(const std::string& file);
  ~FrameInput();
  FrameInput(const FrameInput&) = delete;
  FrameInput& operator=(const FrameInput&) = delete;

  /// Reads the next frame, whose number among all frames of the command is `number`; false at the end. Checks it
  /// against `content`, and fills in content.vertices if it is 0. Throws Error (io, truncated, malformed, limit, usage)
  /// with the input, the number of the frame and the line or byte.
  bool read(FrameContent& content, FrameArrays& frame, std::uint64_t number);

private:
  std::size_t readSome(std::span<std::uint8_t> out);
  std::size_t readAll(std::span<std::uint8_t> out);
  bool isPly();
  bool readRaw(const FrameContent& content, FrameArrays& frame, const std::string& location);
  bool readPly(FrameContent& content, FrameArrays& frame, const std::string& location);

  std::string name_;
  int file_;
  Bytes begin_; ///< the first bytes, until they are read again
  std::optional<PlyFrameReader> ply_;
  bool isKnown_ = false; ///< whether the kind is known
};

} // namespace imgeo::cli
