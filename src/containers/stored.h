#pragma once
// What both containers store of a vertex, and what both readers check:
// docs/formats/nodes.md, "Stored values".

#include "containers/container.h"

#include <span>
#include <string>

namespace imgeo {

/// Where a texture coordinate is in the box that begins at `min`: 0 .. 1; 0 in a box
/// without extent.
double texCoordShare(float value, float min, float size);

/// The same in 16 bits, and back.
std::uint16_t storeTexCoord(float value, float min, float size);
float loadTexCoord(std::uint16_t stored, float min, float size);

/// How far a texture coordinate may be from what is stored of it, in SIG in `bits` bits: half a
/// step of its box, and what single precision adds.
Vec2<double> texCoordErrorBound(const GeometryDescription& geometry, std::uint32_t bits);

/// The direction of a stored normal; (0, 0, 1) for one without length.
Vec3f unitNormal(Vec3d stored);

/// Indices or records that the draws take together.
std::uint64_t drawnCount(std::span<const Draw> draws);

/// The tight box of vertices as they are stored.
Box3d boxOf(std::span<const Vec3u> positions, const GeometryDescription& geometry);

/// The fields of a description that are the same in every container, and no references.
PatchDescription describePatch(const IndexedPatch& patch, const GeometryDescription& geometry);

/// How many records a patch has: as its description says, or by its largest
/// index. Throws Error{malformed} with `location` for an index beyond them.
std::uint32_t recordCountOf(const PatchDescription& patch, std::span<const std::uint32_t> indices,
                            const std::string& location);

/// Throws Error{malformed} with `location` where a point lies outside of the box
/// that the description states (if it states one): planes in the wrong order
/// and files of another patch show here.
void checkInsideBox(std::span<const Vec3u> positions, const GeometryDescription& geometry, const Box3d& box,
                    const std::string& location);

/// Appends a file to an encoded patch.
FileIndex addFile(EncodedPatch& encoded, EncodedFile file);

} // namespace imgeo
