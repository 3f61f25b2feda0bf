#pragma once
// What encodings share: stored values (docs/formats/nodes.md), descriptions of patches, and checks of readers.

#include "containers/patch_encoder.h"

#include <span>
#include <string>

namespace imgeo {

/// A texture coordinate as fractions, 0 .. 1, of its box; 0 on an axis along which the box has no extent.
Vec2<double> texCoordFraction(const Vec2f& texCoord, const TexCoordBox& box);

/// The texture coordinate of these fractions.
Vec2f texCoordAt(const Vec2<double>& fraction, const TexCoordBox& box);

/// The maximum error of a stored texture coordinate: half a step of its box, and the rounding of single precision. SIG
/// stores `bits` bits, bg the type of the description.
Vec2<double> texCoordErrorBound(const GeometryDescription& geometry, std::size_t set, std::uint32_t bits);

/// The maximum error of a stored colour's channel, 0 .. 1, likewise.
double colorErrorBound(const GeometryDescription& geometry, std::uint32_t bits);

/// The unit vector of a stored normal; (0, 0, 1) for a zero vector.
Vec3f unitNormal(Vec3d stored);

/// The number of indices or records that all draws use.
std::uint64_t drawnCount(std::span<const Draw> draws);

/// The tight box of stored vertices.
Box3d boxOf(std::span<const Vec3u> positions, const GeometryDescription& geometry);

/// The fields of a description that classic and bg share, without references.
PatchDescription describePatch(const IndexedPatch& patch, const GeometryDescription& geometry);

/// The number of records of a patch: as the description states; otherwise the largest index + 1 or, without an index,
/// the number of drawn records. Throws Error{malformed} for an index or a draw beyond them and for a patch that draws
/// nothing, Error{limit} for more than 2^32 - 1 records, each with `location`.
std::uint32_t recordCountOf(const PatchDescription& patch, std::span<const std::uint32_t> indices,
                            const std::string& location);

/// Throws Error{malformed} with `location` if a point lies outside of `box`, unless the box is empty, that is, not
/// stated. This detects byte planes in the wrong order and files of another patch.
void checkInsideBox(std::span<const Vec3u> positions, const GeometryDescription& geometry, const Box3d& box,
                    const std::string& location);

/// Appends a file to an encoded patch.
FileIndex addFile(EncodedPatch& encoded, EncodedFile file);

/// The smallest type that indexes the vertices (wedges) of every patch: Uint16 or Uint32.
ElementType indexTypeFor(const PatchedMesh& mesh);

/// Whether all texture coordinates lie within 0..1.
bool hasUnitTexCoords(const PatchedMesh& mesh);

} // namespace imgeo
