#pragma once
// Groups of levels <-> files of SIG compact: docs/formats/levels.md.

#include "containers/compact/compact_patch.h"
#include "containers/patch_encoder.h"
#include "containers/patch_reader.h"
#include "prepare/levels/group_borders.h"
#include "prepare/levels/levels.h"

namespace imgeo {

struct EncodedGroup {
  Bytes bytes;                             ///< of the file
  std::size_t vertices = 0, triangles = 0; ///< of points no triangles
  double normalError = 0;                  ///< largest error of a normal, in radians
};

/// Encodes a group by the fields of its node. Each of its children has a segment with triangles. Normals are stored,
/// also where the options ask for derived ones, which would differ between the two sides of a group's border.
/// Deterministic. Throws Error{limit} for a group that no image holds.
EncodedGroup encodeGroup(GroupMesh mesh, const GeometryDescription& geometry, const EncodeOptions& options);

/// Encodes a group of points: on level 0 one patch, above one for each child, in the order of these. Each has a point.
/// Deterministic. Throws Error{limit} for a group that no image holds.
EncodedGroup encodePointGroup(std::vector<Patch> segments, const GeometryDescription& geometry,
                              const EncodeOptions& options);

/// Reads the triangles of a group, without their attributes; `children` is not set. Safe for untrusted bytes. Throws
/// Error naming the file; {malformed} where it is not as the index says.
GroupTriangles readGroup(const LevelsDescription& levels, std::uint32_t number, const FetchFile& fetch);

/// Reads a group of points: a patch for each child, or one on level 0. Safe for untrusted bytes. Throws Error naming
/// the file; {malformed} where it is not as the index says.
std::vector<compact::CompactPatch> readPointGroup(const LevelsDescription& levels, std::uint32_t number,
                                                  const FetchFile& fetch);

} // namespace imgeo
