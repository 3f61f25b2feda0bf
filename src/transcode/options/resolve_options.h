#pragma once
// Fills in the options of a conversion that depend on others, and refuses contradictions.

#include "base/vec.h"
#include "imgeo/convert.h"
#include "scene/scene.h"

namespace imgeo {

/// The options with all defaults filled in. Throws Error{usage} for options that contradict each other or that the
/// encoding or the target does not support.
ConvertOptions resolved(ConvertOptions options);

/// The options with all defaults filled in for this scene: if no encoding is stated, classic for meshes with more
/// further attributes than compact holds. Throws Error{usage} if the stated encoding cannot hold them, and for a stated
/// view of an X3D source.
ConvertOptions resolvedFor(const Scene& scene, const ConvertOptions& given);

/// The position bits for a mesh with this box: as stated, or the smallest number that keeps the stated maximum error.
/// Throws Error{usage} if no supported number of bits does.
std::uint32_t positionBitsFor(const Box3d& box, const ConvertOptions& options);

/// Whether imgeo.json must state the error of normals, because it does not follow from the document.
bool hasStatedError(const ConvertOptions& options);

} // namespace imgeo
