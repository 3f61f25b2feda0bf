#pragma once
// What X3DOM does not read of a scene.

#include "scene/scene.h"

#include <string>
#include <vector>

namespace imgeo {

/// Leaves out what X3DOM does not read, with a warning for each kind. Returns whether sets of texture coordinates have
/// been left out.
bool leaveOutForX3dom(Scene& scene, std::vector<std::string>& warnings);

} // namespace imgeo
