#pragma once
// What the options of a conversion mean together.

#include "base/vec.h"
#include "imgeo/convert.h"
#include "scene/scene.h"

namespace imgeo {

/// The same options with every default filled in that depends on others. Throws
/// Error{usage}, one sentence, for options that contradict each other or that the
/// container or the target cannot honour.
ConvertOptions resolved(ConvertOptions options);

/// The same for what is there to convert: where nothing says which profile, classic for more
/// further attributes than compact holds. Throws Error{usage} where compact was asked for.
ConvertOptions resolvedFor(const Scene& scene, const ConvertOptions& given);

/// The position bits for a mesh: as stated, or the fewest within the stated error.
/// Throws Error{usage} for an error that the most bits exceed.
std::uint32_t positionBitsFor(const Box3d& box, const ConvertOptions& options);

/// Whether a site has to say how far its normals may be off, because no reader could tell.
bool hasStatedError(const ConvertOptions& options);

} // namespace imgeo
