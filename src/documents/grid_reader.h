#pragma once
// Reads the fields of an ImageGeometry whose images are grids of vertices. web/src/document/gridPatches.ts reads and
// refuses the same.

#include "containers/geometry_description.h"
#include "documents/field_reader.h"

#include <cstdint>
#include <optional>

namespace imgeo {

/// Columns and rows, 1..65,536, of `implicitMeshSize` or `implicitMeshCount`, the paper's name for it. Throws
/// Error{malformed} for numbers that are no size.
Vec2<std::uint32_t> implicitMeshSizeOf(const FieldReader& fields, Vec2<std::uint32_t> fallback);

/// Column and row of a patch's first vertex in a height map. Throws Error{malformed} for numbers that are none.
Vec2<std::uint32_t> gridOriginOf(const FieldReader& fields);

/// The grid that `implicitMeshMode` names; none for vertices in sequence. Throws Error{unsupported} for other modes.
std::optional<GridKind> gridOf(const FieldReader& fields);

/// Sets the vertices and triangles that follow from the sizes of the grids, and what the node states of its distance
/// from its source. Throws Error for grids without a surface and beyond the limits (containers/limits.h).
void describeGrids(const FieldReader& fields, GeometryDescription& geometry);

} // namespace imgeo
