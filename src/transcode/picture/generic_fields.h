#pragma once
// Fields of the nodes of X3D sources that pictures depend on. These nodes are kept as text (GenericNode).

#include "scene/scene.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace imgeo {

/// The text of an attribute; null if the element lacks it.
const std::string* fieldOf(const Node& node, std::string_view name);

/// Replaces `values` by the first numbers of the attribute, as many as both have; not where a word is no number.
void readNumbers(const Node& node, std::string_view name, std::span<double> values);

/// Whether a node counts as a child of a grouping node: comments and metadata do not.
bool isChildNode(const Node& node);

/// The viewpoint that a node is, read or kept as text; nothing for other nodes. An OrthoViewpoint becomes the Viewpoint
/// that sees its rectangle around the origin of its axes from its position.
std::optional<Viewpoint> viewpointOf(const Node& node);

/// The sky's colour at the zenith of the first Background or TextureBackground of a scene in document order; nothing if
/// there is none.
std::optional<Vec3f> skyColorOf(const SceneGraph& graph);

} // namespace imgeo
