#pragma once
// Lights and cameras of VRML 1.0 as X3D nodes.

#include "base/affine.h"
#include "import/vrml/elements.h"
#include "import/vrml1/tree.h"

namespace imgeo::vrml1 {

/// Adds a light, which shines on the children of `group`. `matrix` is the light's transform in the coordinates of the
/// group.
void addLight(pugi::xml_node group, const Node& node, const Affine3d& matrix, x3d::VrmlElements& elements);

/// Adds a Viewpoint or OrthoViewpoint whose description is the node's name.
void addCamera(pugi::xml_node parent, const Node& node, x3d::VrmlElements& elements);

} // namespace imgeo::vrml1
