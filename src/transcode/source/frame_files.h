#pragma once
// The source files of a sequence: a mesh for each frame, all with the elements of the first.

#include "import/import.h"
#include "scene/scene.h"
#include "transcode/source/frame_source.h"

#include <filesystem>
#include <vector>

namespace imgeo {

/// Reads the frames of a sequence. Vertices are the wedges of a file's mesh, in the order of the file.
class FrameFiles : public FrameSource {
public:
  /// `first`: what the first file holds, before it is prepared. `options`: those with which it was read, and the origin
  /// that it got, which all frames have. Throws Error{unsupported} unless it is one mesh that is shown once.
  FrameFiles(std::vector<std::filesystem::path> files, const Scene& first, ImportOptions options);

  std::size_t count() const override { return files_.size(); }

  /// Throws Error for a file that cannot be read, and Error{malformed} for a mesh whose elements, texture coordinates
  /// or attributes are not those of the first.
  Mesh read(std::size_t frame) const override;

  /// The sum of the files' sizes.
  std::uint64_t bytes() const;

private:
  std::vector<std::filesystem::path> files_;
  Mesh first_;
  ImportOptions options_;
};

} // namespace imgeo
