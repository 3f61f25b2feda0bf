#pragma once
// Base meshes of compact -> files that several of them share.

#include "containers/geometry_description.h"
#include "transcode/encode/file_contents.h"
#include "transcode/site/content_files.h"

#include <utility>
#include <vector>

namespace imgeo {

/// Collects the base meshes of all geometries and writes them, in one file as long as they fit into it.
class BaseFiles {
public:
  explicit BaseFiles(ContentFiles& files) : files_(files) {}

  /// Takes the base mesh of the geometry with this index.
  void add(compact::CompactPatch base, std::size_t geometryIndex);

  /// Writes the last file and sets the base reference of every geometry that has one.
  void finish(std::vector<GeometryDescription>& geometries);

private:
  void writeContents();

  ContentFiles& files_;
  FileContents contents_;
  std::vector<std::size_t> geometryIndices_; ///< of the bases in `contents_`
  std::vector<std::pair<std::size_t, Reference>> references_;
};

} // namespace imgeo
