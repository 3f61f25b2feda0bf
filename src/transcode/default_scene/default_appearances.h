#pragma once
// Appearances for shapes whose source states none, and for points and lines, which X3D does not light.

#include "documents/documents.h"

namespace imgeo {

/// Gives every shape without an appearance a stone material, and every shape of points or lines a copy of its
/// appearance whose emissive colour is visible without light.
void assignDefaultAppearances(SceneDocument& document);

} // namespace imgeo
