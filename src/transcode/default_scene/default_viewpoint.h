#pragma once
// Rounds the numbers of a viewpoint and sets the centres of rotation of all viewpoints.

#include "scene/scene.h"

namespace imgeo {

/// The viewpoint with its numbers rounded to few digits, each by less than a millionth of the distance to its centre of
/// rotation.
Viewpoint withShortNumbers(Viewpoint viewpoint);

/// Sets every viewpoint's centre of rotation, which sources do not state, to `center` (world coordinates). A USEd
/// viewpoint gets it in the coordinates of its first instance.
void setCentersOfRotation(SceneGraph& graph, Vec3d center);

} // namespace imgeo
