#pragma once
// What both containers store of a vertex, and what both readers check:
// docs/formats/nodes.md, "Stored values".

#include "containers/container.h"

#include <span>
#include <string>

namespace imgeo {

/// Lattice coordinate -> stored integer, and back. Throws Error{malformed} with
/// `place` for a stored integer that is no lattice point.
inline std::uint32_t storeCoord(std::uint32_t q, std::uint32_t shift) {
  return q << shift;
}
std::uint32_t loadCoord(std::uint32_t stored, std::uint32_t shift, const std::string& place);

/// Texture coordinate -> 16 bits over the box that begins at `min`, and back.
std::uint16_t storeTexCoord(float value, float min, float size);
float loadTexCoord(std::uint16_t stored, float min, float size);

/// The direction of a stored normal; (0, 0, 1) for one without length.
Vec3f unitNormal(Vec3d stored);

/// Indices or records that the draws take together.
std::uint64_t drawnCount(std::span<const Draw> draws);

/// The tight box of lattice points.
Box3d boxOf(std::span<const Vec3u> positions, const Lattice& lattice);

/// The fields of a description that are the same in every container, and no references.
PatchDescription describePatch(const IndexedPatch& patch, const GeometryDescription& geometry);

/// How many records a patch has: as its description says, or by its largest
/// index. Throws Error{malformed} with `place` for an index beyond them.
std::uint32_t recordCountOf(const PatchDescription& patch, std::span<const std::uint32_t> indices,
                            const std::string& place);

/// Throws Error{malformed} with `place` where a point lies outside of the box
/// that the description states (if it states one): planes in the wrong order
/// and files of another patch show here.
void checkInsideBox(std::span<const Vec3u> positions, const Lattice& lattice, const Box3d& box,
                    const std::string& place);

/// Appends a file to an encoded patch and refers to it by its index.
Reference addFile(EncodedPatch& encoded, EncodedFile file);

} // namespace imgeo
