#pragma once
// Repairs of what Assimp's own readers leave in scenes and its validation then refuses, though nothing is missing.

#include <assimp/scene.h>

namespace imgeo {

/// Lengthens animations to their last key, and gives lights of one name and their nodes names of their own. `scene` may
/// break any other rule of Assimp's.
void repair(aiScene& scene);

} // namespace imgeo
