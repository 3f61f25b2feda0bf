#pragma once
// The source files of a sequence: a mesh for each frame, all with the elements of the first.

#include "imgeo/preparation.h"
#include "scene/mesh.h"
#include "scene/scene.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace imgeo {

/// What the frames have in common.
struct FrameSurvey {
  Box3d box;               ///< of the positions of all frames
  bool hasNormals = false; ///< the source has them
  bool colorsMove = false; ///< colours differ from frame to frame
  std::uint64_t bytes = 0; ///< of all files
};

/// Reads the frames of a sequence. Vertices are the wedges of a file's mesh, in the order of the file.
class FrameFiles {
public:
  /// `first`: what the first file holds, before it is prepared. Throws Error{unsupported} unless it is one mesh that is
  /// shown once.
  FrameFiles(std::vector<std::filesystem::path> files, const Scene& first, bool outside);

  std::size_t count() const { return files_.size(); }

  /// The mesh of a frame. Safe to call from any thread. Throws Error for a file that cannot be read, and
  /// Error{malformed} for a mesh whose elements, texture coordinates or attributes are not those of the first.
  Mesh read(std::size_t frame) const;

  /// Reads all frames, several at a time, and calls done() after each.
  FrameSurvey survey(const std::function<void()>& done) const;

private:
  std::vector<std::filesystem::path> files_;
  Mesh first_;
  bool outside_;
};

/// The further attribute that keeps the number of each vertex of a source until it has been encoded.
inline constexpr const char* sourceVertexName = "imgeo:source vertex";

/// Gives the wedges of a mesh their numbers as a further attribute, so that none of them are merged. Throws
/// Error{limit} for more than live::maxFrameVertices.
void numberVertices(Mesh& mesh);

/// Removes that attribute and returns the numbers.
std::vector<std::uint32_t> takeVertexNumbers(VertexAttributes& vertices);

} // namespace imgeo
