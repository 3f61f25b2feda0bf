#pragma once
// Models far from zero, as surveys make them: whole units are subtracted from coordinates that have more digits than
// single precision.

#include "base/vec.h"
#include "import/import.h"

namespace imgeo {

/// What is subtracted from the coordinates of a model whose first vertex is `first`: its whole units on each axis on
/// which it is 2^16 (65,536) or more from zero, where single precision has steps of 1/128 and more; 0 on the others.
/// Also 0 from 2^40 on: nothing is surveyed there, and shapes beyond maxDrawableLength are refused as they are stated.
/// The first vertex alone decides, so that files that are read piece by piece get the same.
Vec3d farOriginOf(const Vec3d& first);

/// Sets the origin of what has been imported, and states it as metadata of the first root unless it is 0 on all axes.
void setOrigin(Imported& imported, const Vec3d& origin);

} // namespace imgeo
