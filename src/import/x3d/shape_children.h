#pragma once
// Which children of a Shape count: its geometry, and what pages need of it beside the mesh.

#include "import/x3d/faults.h"
#include "import/x3d/source.h"

namespace imgeo::x3d {

/// Whether a child of a Shape is a geometry, as another one before it is.
bool isFurtherGeometry(pugi::xml_node child, pugi::xml_node parent);

/// Warns of several geometries in a Shape: the first counts, as in pages. If strict, throws Error{malformed}.
void requireOneGeometry(const Source& source, pugi::xml_node shape, Faults& faults);

/// The TextureCoordinateGenerator of the geometry of a Shape with a cube map whose mode depends on the camera: pages
/// draw cube maps by it. It becomes a child of the Shape, since a written geometry has no such node. A null node where
/// there is none.
pugi::xml_node cameraGeneratorOf(const Source& source, pugi::xml_node shape, pugi::xml_node geometry);

} // namespace imgeo::x3d
