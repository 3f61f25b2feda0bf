#pragma once
// Scenes for formats without hierarchy: every shape with its mesh in world coordinates.

#include "scene/scene.h"

#include <functional>

namespace imgeo {

using VisitWorldShape = std::function<void(const std::string& name, const Appearance& appearance, const Mesh& mesh)>;

/// Calls `visit` for every instance of a shape. The mesh is valid during the call.
void forEachWorldShape(const Scene& scene, const VisitWorldShape& visit);

/// The mesh with transformed positions and normals. A mirroring transform reverses triangles, so that front faces stay
/// front faces.
Mesh transformed(Mesh mesh, const Affine3d& world);

} // namespace imgeo
