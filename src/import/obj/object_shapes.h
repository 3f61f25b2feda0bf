#pragma once
// The shapes of the objects of an OBJ file.

#include "import/obj/materials.h"
#include "import/obj/object.h"

#include <functional>
#include <optional>
#include <span>
#include <string>

namespace imgeo {

/// Gives the mesh of the triangles or of the lines of a subset; nothing where it has none.
using ObjMeshSource = std::function<std::optional<Mesh>(const ObjObject& subset, Topology topology)>;

/// Adds a mesh and a shape for the triangles and the lines of each subset. An object of several subsets, which follow
/// one another, becomes a Group. `fileName` names meshes of objects without a name.
void addObjectShapes(Scene& scene, std::span<const ObjObject> subsets, const ObjMeshSource& meshOf,
                     ObjMaterials& materials, const std::string& fileName);

/// Warns of objects of which some corners have no normals.
void warnOfPartialNormals(std::vector<std::string>& warnings, std::size_t objects);

} // namespace imgeo
