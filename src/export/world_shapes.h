#pragma once
// Scenes for formats that know no hierarchy: every shape with its mesh where the
// world has it.

#include "scene/scene.h"

#include <functional>

namespace imgeo {

using VisitWorldShape = std::function<void(const std::string& name, const Appearance& appearance, const Mesh& mesh)>;

/// Calls `visit` for every shape as often as it is seen; the mesh is gone with the call.
void forEachWorldShape(const Scene& scene, const VisitWorldShape& visit);

/// The mesh where `world` puts it: normals follow, and a mirror image keeps its
/// front sides.
Mesh transformed(Mesh mesh, const Affine3d& world);

} // namespace imgeo
