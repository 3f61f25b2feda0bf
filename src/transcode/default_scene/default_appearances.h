#pragma once
// Appearances for shapes whose source states none, and for points and lines without normals, which are not lit.

#include "documents/documents.h"

#include <vector>

namespace imgeo {

/// Gives every shape without an appearance a stone material, and every shape of points or lines without normals a copy
/// of its appearance whose emissive colour is visible without light. `hasNormals`: by geometry.
void assignDefaultAppearances(SceneDocument& document, const std::vector<bool>& hasNormals);

} // namespace imgeo
