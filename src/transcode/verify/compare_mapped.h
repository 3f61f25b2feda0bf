#pragma once
// Compares a mesh of the input with a geometry of the site whose node has operators.

#include "containers/container_reader.h"
#include "imgeo/verify.h"
#include "scene/mesh.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Compares the vertices and elements that pages draw with those of the input. Operators may bring different vertices
/// to one point, so that elements are compared by their number, and by their centres and vertices: each lies, in either
/// direction, within the mapped half step of the lattice from another.
void compareMapped(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                   VerifyReport& report, Findings& findings);

} // namespace imgeo
