#pragma once
// A work file of meshes: what is known of each, by which one is read without the others.

#include "base/bytes.h"
#include "imgeo/preparation.h"
#include "scene/mesh.h"
#include "transcode/out_of_core/work_folder.h"

#include <string>
#include <vector>

namespace imgeo {

/// What is known of a mesh of a work file.
struct MeshFileEntry {
  std::uint64_t mesh = 0; ///< its number in the scene
  std::uint64_t offset = 0, bytes = 0, elements = 0;
  Box3d box;
};

/// What was found when the meshes of a work file were read from their source.
struct MeshFileFindings {
  std::vector<std::string> attributes, warnings;
  double colorError = 0;
  EdgeReport edges{};
};

class MeshFileWriter {
public:
  /// Adds a mesh with its number in the scene.
  void add(std::size_t number, const Mesh& mesh);
  /// The content of the file, at the end.
  Bytes finish(const MeshFileFindings& findings);

private:
  WorkWriter out_;
  std::vector<MeshFileEntry> entries_;
};

/// Reads what MeshFileWriter wrote. Safe for untrusted bytes.
class MeshFile {
public:
  /// `bytes` must outlive this. Throws Error{malformed} naming `path`.
  MeshFile(ByteSpan bytes, std::string path);

  const std::vector<MeshFileEntry>& entries() const { return entries_; }
  const MeshFileFindings& findings() const { return findings_; }
  /// A mesh of an entry of this file, which keeps the invariants of meshes. Safe to call from any thread. Throws
  /// Error{malformed}.
  Mesh read(const MeshFileEntry& entry) const;
  /// Forgets the entries, which the caller has copied.
  void dropEntries() { std::vector<MeshFileEntry>().swap(entries_); }

private:
  [[noreturn]] void fail() const;

  ByteSpan bytes_;
  std::string path_;
  std::vector<MeshFileEntry> entries_;
  MeshFileFindings findings_;
};

} // namespace imgeo
