#pragma once
// Whether a mesh without normals is shaded better with creases.

#include "scene/mesh.h"

namespace imgeo {

/// Whether a triangle mesh seems to be a man-made object, as furniture and machine parts are, instead of a scan or a
/// smooth model. Of the edges at some of its vertices at least a quarter are between triangles of one plane, and as
/// many are sharper than manMadeCreaseDegrees as are between a third of that and it. Scans have fewer edges the sharper
/// these are.
bool isManMade(const Mesh& mesh);

} // namespace imgeo
