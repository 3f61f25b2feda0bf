#pragma once
// Finds out which axis of a source points up, and what its unit is.

#include "imgeo/source_axes.h"
#include "import/import.h"
#include "scene/stored_meshes.h"

namespace imgeo {

/// The steps from source to document coordinates: what the options state, else what the file says, else a guess by the
/// shape of the scene. `stored`: meshes that are on the disk.
SourceAxesReport detectAxes(const Imported& imported, const SourceAxesOptions& options,
                            const StoredMeshes* stored = nullptr);

} // namespace imgeo
