#pragma once
// Makes the default viewpoint and sets the centres of rotation of all viewpoints.

#include "scene/scene.h"

namespace imgeo {

/// A viewpoint that shows the whole box. Its numbers are rounded to few digits, each by less than a millionth of
/// the distance to the box's centre.
Viewpoint viewpointFraming(const Box3d& box);

/// Sets every viewpoint's centre of rotation, which sources do not state, to `center` (world coordinates). A USEd
/// viewpoint gets it in the coordinates of its first instance.
void setCentersOfRotation(SceneGraph& graph, Vec3d center);

} // namespace imgeo
