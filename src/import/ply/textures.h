#pragma once
// Textures of PLY files, as MeshLab and photogrammetry tools write them: each comment "TextureFile NAME" names an image
// file beside the PLY file, and the property 'texnumber' of a face counts these comments from 0.

#include "import/import.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// A face without a texture.
inline constexpr std::uint32_t noPlyTexture = 0xffffffff;

/// The triangles of a mesh that have the same texture.
struct TexturedPart {
  std::uint32_t texture = noPlyTexture;
  Mesh mesh; ///< has the positions and wedges that its triangles use, in the order of first use
};

/// Divides a mesh of triangles by their textures: parts in the order of the textures, that without one last.
/// `textures`: of each triangle.
std::vector<TexturedPart> dividedByTexture(Mesh mesh, std::span<const std::uint32_t> textures);

/// Gives each part an appearance with its image, and adds it as a shape. Vertex colours of a part with an image are
/// left out: the file has them for viewers that display no textures. Adds warnings of what is left out.
void addTexturedShapes(Imported& imported, std::vector<TexturedPart> parts, const std::vector<std::string>& files,
                       const ImportOptions& options, const std::string& name);

/// Whether `file`, which a comment names, is an image that can be read.
bool isReadablePlyTexture(const std::string& file, const ImportOptions& options, const std::string& name);

} // namespace imgeo
