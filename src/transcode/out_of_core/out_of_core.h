#pragma once
// Builds the levels of detail of a mesh or a point cloud that memory does not hold: docs/decisions/out-of-core.md.

#include "import/chunks/chunked_source.h"
#include "transcode/encode/encode_mesh.h"
#include "transcode/out_of_core/ranks.h"
#include "transcode/site/content_files.h"

namespace imgeo {

/// A mesh, or a cloud, whose levels have been written.
struct LargeMesh {
  EncodedMesh encoded;
  Imported coarse; ///< the source with a coarse form as its mesh
  double colorError = 0;
  bool normalsComputed = false;
  std::size_t tasks = 0; ///< of all ranks
};

/// The faces or points of a piece of a source whose levels have regions of so many triangles or points.
std::uint64_t pieceRecords(std::uint32_t regionTriangles);

/// The least memory in which regions of so many triangles or points are built.
std::uint64_t minimumMemory(std::uint32_t regionTriangles);

/// An estimate of the memory that converting the source in memory takes.
std::uint64_t inCoreMemory(const ChunkedSource& source);

/// Converts a source of more triangles or points than a region has. `options` are resolved. The files of the groups are
/// the same as in memory. Work files are in that of `ranks`, which is left to the caller; `progress` gets shares of
/// this step's work. Only on rank 0.
LargeMesh buildOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions, const ConvertOptions& options,
                         Ranks& ranks, ContentFiles& files, const Progress& progress);

/// What the other ranks do meanwhile. Returns the number of tasks of all ranks.
std::size_t shareOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions,
                           const ConvertOptions& options, Ranks& ranks, const Progress& progress);

} // namespace imgeo
