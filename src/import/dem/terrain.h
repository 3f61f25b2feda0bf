#pragma once
// The surface of a height grid as a Shape with its georeference as metadata.

#include "import/dem/ground.h"
#include "scene/scene.h"

#include <string>

namespace imgeo {

/// The triangles between the cells of a grid: two for each four neighbours with heights, one for three. They are split
/// from the lower left to the upper right cell, as in grids of images (containers/grid.h), and seen from above. Throws
/// Error{malformed} with `name` for a grid without any three such neighbours. `keepsHeights`: vertices have the file's
/// numbers as an attribute, heightName.
Mesh terrainMesh(const HeightGrid& grid, const Ground& ground, bool keepsHeights, const std::string& name);

inline constexpr const char* heightName = "height";

/// Adds a MetadataSet "georeference" to a node: docs/terrain.md states its values.
void addGeoreference(SceneGraph& graph, std::size_t node, const HeightGrid& grid, const Ground& ground);

} // namespace imgeo
