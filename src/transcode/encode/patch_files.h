#pragma once
// Small patches of compact -> files that several of them share.

#include "transcode/encode/encode_mesh.h"
#include "transcode/encode/file_contents.h"

#include <cstdint>
#include <map>
#include <vector>

namespace imgeo {

/// Distributes patches over files in the order of add(): consecutive patches of a group share a file. Patches of
/// different groups never do. Encodes several files at a time; the result does not depend on how many.
class PatchFiles {
public:
  /// `files` must outlive this.
  PatchFiles(ContentFiles& files, int effort) : files_(files), effort_(effort) {}

  /// The reference to the patch of a geometry.
  struct WrittenPatch {
    std::size_t geometryIndex = 0;
    Reference data;
    double normalError = 0; ///< maximum error of its normals, in radians
  };

  /// Takes the only patch of a geometry. `group`: see loadGroups.
  void add(compact::CompactPatch patch, std::size_t geometryIndex, std::size_t group);

  /// Writes the remaining files and returns all references. Call it once, at the end.
  std::vector<WrittenPatch> finish();

private:
  struct File {
    FileContents contents;
    std::vector<std::size_t> geometryIndices;
  };

  void encodeClosed();

  ContentFiles& files_;
  int effort_;
  std::map<std::size_t, File> open_; ///< by group
  std::vector<File> closed_;
  std::vector<WrittenPatch> written_;
};

} // namespace imgeo
