#pragma once
// The meshes of a source that are converted one by one behind the large ones, or together where memory holds them.

#include "transcode/out_of_core/mesh_files.h"
#include "transcode/out_of_core/out_of_core.h"

namespace imgeo {

/// The numbers of the meshes that are not among largeMeshes(). `options` are resolved.
std::set<std::size_t> smallMeshes(const ChunkedSource& source, const ConvertOptions& options);

/// Whether the memory of the options, which are resolved, holds the small meshes together.
bool fitTogether(const ChunkedSource& source, const ConvertOptions& options);

/// Refuses --memory where it does not hold the largest of the small meshes, and what is known of all meshes, together.
/// `options` are resolved.
void requireMemoryForMeshes(const ChunkedSource& source, const ConvertOptions& options);

/// Reads and prepares the small meshes, in batches that take a quarter of the memory and are no larger than a region,
/// into files of the work folder of `ranks`. Batches whose files are there are left out. Only on rank 0. `progress`
/// gets shares of this step's work.
std::unique_ptr<MeshFiles> storeSmallMeshes(const ChunkedSource& source, const ImportOptions& importOptions,
                                            const ConvertOptions& options, Ranks& ranks, const Progress& progress);

} // namespace imgeo
