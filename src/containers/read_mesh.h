#pragma once
// Decodes the files of a geometry into one mesh.

#include "containers/container_reader.h"
#include "scene/mesh.h"

#include <string>

namespace imgeo {

/// Decodes the patches of a geometry, several at a time, into one mesh: equal lattice points become one position, also
/// across patch borders, and equal vertices one wedge. Degenerate triangles, which join strips, are dropped. Then the
/// geometry's operators map the mesh. Safe for untrusted bytes. Throws Error with the file's url; with `location`,
/// Error{unsupported} for a geometry with several kinds of elements (splitByTopology), Error{limit} for one of more
/// than 2^32 - 1 vertices. With `keepsVertices` nothing is merged or dropped: wedges are the records of the patches.
Mesh readMesh(const ContainerReader& reader, const GeometryDescription& geometry, const std::string& location,
              bool keepsVertices = false);

/// The box in which the operators of a geometry map the vertices of its decoded mesh: the decode box; for floats the
/// box around the patches, or where a patch has none and neither the geometry, around the vertices.
OperatorFrame operatorFrameOf(const GeometryDescription& geometry, const Mesh& mesh);

} // namespace imgeo
