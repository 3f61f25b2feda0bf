#pragma once
// Encodes small patches into files that several of them share.

#include "containers/shared_file.h"
#include "transcode/encode/encode_mesh.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace imgeo {

/// Distributes patches over files in the order of add(): consecutive patches of a group share a file. Patches of
/// different groups never do. Encodes several files at a time; the result does not depend on how many.
class PatchFiles {
public:
  /// `files` must outlive this. `sharing` is nullptr for encodings whose patches share no files.
  PatchFiles(ContentFiles& files, const FileSharing* sharing, int effort)
      : files_(files), sharing_(sharing), effort_(effort) {}

  /// Takes the only patch of a geometry. `group`: see loadGroups.
  void add(std::unique_ptr<PreparedPatch> patch, std::size_t geometryIndex, std::size_t group);

  /// Ends the file of a group that gets no more patches.
  void close(std::size_t group);

  /// Writes the remaining files, sets the references to all patches in their geometries, and returns the maximum error
  /// of their normals, in radians. Call it once, at the end.
  double finish(std::vector<GeometryDescription>& geometries);

private:
  /// The reference to the patch of a geometry.
  struct WrittenPatch {
    std::size_t geometryIndex = 0;
    Reference data;
    double normalError = 0; ///< maximum error of its normals, in radians
  };
  struct File {
    std::unique_ptr<SharedFile> contents; ///< nullptr: no patch yet
    std::vector<std::size_t> geometryIndices;
  };

  void encodeClosed();

  ContentFiles& files_;
  const FileSharing* sharing_;
  int effort_;
  std::map<std::size_t, File> open_; ///< by group
  std::vector<File> closed_;
  std::vector<WrittenPatch> written_;
};

} // namespace imgeo
