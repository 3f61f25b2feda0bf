#pragma once
// Small patches of compact -> files that many of them share.

#include "containers/compact/compact.h"
#include "transcode/encode/encode_mesh.h"

#include <cstdint>
#include <map>
#include <vector>

namespace imgeo {

/// The patches of one file to be, as far as they fit into it.
class FileContents {
public:
  /// Whether one more fits, of which the file then has at most `mostVertices` (wedges).
  /// One always fits into a file of its own.
  bool fits(const compact::CompactPatch& patch, std::size_t mostVertices) const;
  void add(compact::CompactPatch patch);
  const std::vector<compact::CompactPatch>& patches() const { return patches_; }

private:
  /// What a header says once for all patches that have it in common.
  struct Kind {
    Topology topology = Topology::triangles;
    std::uint32_t positionBits = 16;
    std::vector<compact::AttributeType> attributes;
    friend bool operator==(const Kind&, const Kind&) = default;
  };
  static Kind kindOf(const compact::CompactPatch& patch);

  std::vector<compact::CompactPatch> patches_;
  std::vector<Kind> kinds_;
  std::size_t wedges_ = 0, elements_ = 0;
};

/// Gathers patches in the order in which they come: neighbours in it load together. Patches of different groups never
/// share a file. Files are encoded several at a time; the result does not depend on it.
class PatchFiles {
public:
  /// `files` and whatever `placed` refers to outlive this.
  PatchFiles(ContentFiles& files, int effort) : files_(files), effort_(effort) {}

  /// Where the patch of a geometry lies, and by how many radians its normals are off.
  struct Placed {
    std::size_t geometry = 0;
    Reference data;
    double normalError = 0;
  };

  /// Takes the only patch of a geometry.
  void add(compact::CompactPatch patch, std::size_t geometry, std::size_t group);

  /// Writes what is still here, and tells where each patch lies. To be called once, at the end.
  std::vector<Placed> finish();

private:
  struct File {
    FileContents contents;
    std::vector<std::size_t> geometries;
  };

  void encodeClosed();

  ContentFiles& files_;
  int effort_;
  std::map<std::size_t, File> open_; ///< by group
  std::vector<File> closed_;
  std::vector<Placed> placed_;
};

} // namespace imgeo
