#pragma once
// The images of textures -> files of a site: as they are, smaller, or in another format.

#include "scene/scene.h"
#include "transcode/encode/encode_mesh.h"

namespace imgeo {

/// What an image is to those who show it.
struct ImageUse {
  bool isSeen = false;
  bool isColor = false;  ///< people look at it
  bool isData = false;   ///< shading computes with its numbers
  bool isNormal = false; ///< with directions
};

/// By image of the graph.
std::vector<ImageUse> imageUses(const SceneGraph& graph);

/// Writes the images of what is seen, and no others, and gives them their urls. What no
/// browser shows is always re-encoded, and what does not decode then leaves the scene
/// with a warning (Error where `options` are strict). An image is re-encoded at its own
/// size only where that takes fewer bytes, and never made larger. Large ones that people
/// look at get a preview.
TextureReport writeTextures(SceneGraph& graph, const ConvertOptions& options, ContentFiles& files,
                            std::vector<std::string>& warnings);

} // namespace imgeo
