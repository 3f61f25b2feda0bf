#pragma once
// The texture of a mesh of which its groups of levels of detail get images of their own.

#include "scene/scene.h"

#include <string>

namespace imgeo {

/// The texture of a mesh, as far as images of groups can be made of it.
struct Atlas {
  const ImageFile* image = nullptr; ///< null: none can be made
  std::string obstacle{};           ///< why not, although the mesh has a texture; empty: it has none, or `image`
  std::string shape{};              ///< the name of the mesh's first shape; may be empty
  std::string material{};           ///< that of its material; may be empty
};

/// The image of a mesh whose shapes have one appearance with one texture, of colours, by the first set of texture
/// coordinates as they are. `geometry`: its number, as shapes of the graph state it.
Atlas atlasOf(const SceneGraph& graph, std::size_t geometry, const Mesh& mesh);

/// The sentence that the groups of the atlas's mesh have no images.
std::string wholeImageWarning(const Atlas& atlas, const std::string& reason);

} // namespace imgeo
