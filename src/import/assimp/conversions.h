#pragma once
// Vectors, maps and names of Assimp as those of scenes.

#include "scene/transform.h"

#include <assimp/types.h>
#include <string>

namespace imgeo {

inline Vec3d vectorOf(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

inline Affine3d mapOf(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

/// A node's name; empty for names that Assimp generates.
inline std::string nameOf(const aiString& name) {
  const std::string text = name.C_Str();
  const bool isGenerated = text.starts_with('$') || text.starts_with('<') || text == "ROOT" || text == "RootNode";
  return isGenerated ? "" : text;
}

} // namespace imgeo
