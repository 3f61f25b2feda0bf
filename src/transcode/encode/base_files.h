#pragma once
// Encodes base meshes into files that several of them share.

#include "containers/shared_file.h"
#include "transcode/site/content_files.h"

#include <utility>
#include <vector>

namespace imgeo {

/// Collects the base meshes of all geometries and writes them, as many in one file as fit into it.
class BaseFiles {
public:
  /// `sharing` is nullptr for encodings without base meshes.
  BaseFiles(ContentFiles& files, const FileSharing* sharing) : files_(files), sharing_(sharing) {}

  /// Takes the base mesh of the geometry with this index.
  void add(std::unique_ptr<PreparedPatch> base, std::size_t geometryIndex);

  /// Writes the last file and sets the base reference of every geometry that has one.
  void finish(std::vector<GeometryDescription>& geometries);

private:
  void writeContents();

  ContentFiles& files_;
  const FileSharing* sharing_;
  std::unique_ptr<SharedFile> file_;         ///< being filled; nullptr: none
  std::vector<std::size_t> geometryIndices_; ///< of the base meshes in `file_`
  std::vector<std::pair<std::size_t, Reference>> references_;
};

} // namespace imgeo
