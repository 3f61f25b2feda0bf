#pragma once
// Builds the levels of detail of meshes and point clouds that memory does not hold: docs/decisions/out-of-core.md.

#include "import/chunks/chunked_source.h"
#include "transcode/encode/encode_mesh.h"
#include "transcode/out_of_core/ranks.h"
#include "transcode/site/content_files.h"

#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// A mesh, or a cloud, whose levels have been written.
struct LargeMesh {
  std::size_t number = 0; ///< in the source
  EncodedMesh encoded;
  Mesh coarse;                                   ///< a coarse form, with positions of the source
  Box3d box;                                     ///< of the mesh
  std::vector<std::string> attributes, warnings; ///< of the import
  double colorError = 0;
  bool normalsComputed = false;
  EdgeReport edges;
  std::size_t tasks = 0; ///< of all ranks
};

/// Converts the large meshes of a source, one after the other. `options` are resolved. The files of the groups are the
/// same as in memory. Work files are in that of `ranks`, which is left to the caller; `progress` gets shares of this
/// step's work. Only on rank 0.
std::vector<LargeMesh> buildOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions,
                                      const ConvertOptions& options, Ranks& ranks, ContentFiles& files,
                                      const Progress& progress);

/// What the other ranks do meanwhile. Returns the number of tasks of all ranks.
std::size_t shareOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions,
                           const ConvertOptions& options, Ranks& ranks, const Progress& progress);

} // namespace imgeo
