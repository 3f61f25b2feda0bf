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

/// The faces or points of a piece of a source whose levels have regions of so many triangles or points.
std::uint64_t pieceRecords(std::uint32_t regionTriangles);

/// The least memory in which regions of so many triangles or points are built.
std::uint64_t minimumMemory(std::uint32_t regionTriangles);

/// An estimate of the memory that converting so many triangles or points in memory takes.
std::uint64_t inCoreMemory(std::uint64_t elements);

/// An estimate of the memory that what is known of so many meshes takes beside: nodes, descriptions, the document.
std::uint64_t structureMemory(std::uint64_t meshes);

/// The numbers of the meshes of a source that are converted out of core, if any of it is: those that get levels and
/// have more triangles or points than a region. `options` are resolved.
std::vector<std::size_t> largeMeshes(const ChunkedSource& source, const ConvertOptions& options);

/// The triangles and points of meshes of a source.
std::uint64_t elementsOf(const ChunkedSource& source, std::span<const std::size_t> meshes);

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
