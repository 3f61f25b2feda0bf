#pragma once
// Comparison of the appearances of a site with those of its input: materials and texture transforms. Pixels of textures
// are not compared.

#include "scene/mesh.h"
#include "scene/scene.h"

#include <optional>
#include <set>
#include <string>

namespace imgeo {

/// Compares the appearances of two shapes. X3D sources have none here: the document contains theirs unchanged. Accepts
/// a Phong material instead of a physical one (X3DOM knows no other), the material that export writes instead of the
/// site's, on points and lines the one that shows them without light, and a missing texture (its file was unusable).
/// `inputMesh`: that of the shape.
bool haveEqualAppearances(const SceneGraph& siteGraph, const Shape& siteShape, const SceneGraph& inputGraph,
                          const Shape& inputShape, const Mesh& inputMesh);

/// URLs of textures that an X3D input refers to but that could not be read; convert keeps such URLs.
std::set<std::string> unreadTextureUrls(const SceneGraph& input);

/// Whether a Shape node has an UnlitMaterial, in an Appearance that was read or in one that an X3D source keeps as it
/// is. Nothing: it has no Appearance.
std::optional<bool> isUnlit(const SceneGraph& graph, const Node& shape);

} // namespace imgeo
