#pragma once
// Writes texture images to files of a site: unchanged, shrunk, or in another format.

#include "scene/scene.h"
#include "transcode/encode/encode_mesh.h"

namespace imgeo {

/// How the scene uses an image.
struct ImageUse {
  bool isUsed = false;   ///< by a texture of a shape or in an X3D document
  bool isColor = false;  ///< as a colour
  bool isData = false;   ///< as numbers: roughness, occlusion, normals ...
  bool isNormal = false; ///< as a normal map
};

/// The uses of every image of the graph.
std::vector<ImageUse> imageUses(const SceneGraph& graph);

/// Writes the used images and sets their URLs. Formats that no browser displays are always re-encoded; such an image
/// that cannot be decoded leaves the scene with a warning (an Error if `options` are strict). Other images are
/// re-encoded at their own size only if that takes fewer bytes. Images are never enlarged. Large colour images get a
/// preview.
TextureReport writeTextures(SceneGraph& graph, const ConvertOptions& options, ContentFiles& files,
                            std::vector<std::string>& warnings);

} // namespace imgeo
