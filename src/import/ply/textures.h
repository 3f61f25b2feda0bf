#pragma once
// Textures of PLY files, as MeshLab and photogrammetry tools write them: each comment "TextureFile NAME" names an image
// file beside the PLY file, and the property 'texnumber' of a face counts these comments from 0.

#include "import/import.h"
#include "import/ply/header.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// A face without a texture.
inline constexpr std::uint32_t noPlyTexture = 0xffffffff;

/// Whether a property of faces says which texture they have.
bool isPlyTextureNumber(const PlyProperty& property);

/// The texture that such a property says. MeshLab writes -1 for faces without one.
std::uint32_t plyTextureOf(double number);

/// The triangles of a mesh that have the same texture.
struct TexturedPart {
  std::uint32_t texture = noPlyTexture;
  std::uint64_t triangles = 0; ///< of the file, of which the mesh may have a part
  Mesh mesh;                   ///< has the positions and wedges that its triangles use, in the order of first use
};

/// Divides a mesh of triangles by their textures: parts in the order of the textures, that without one last.
/// `textures`: of each triangle.
std::vector<TexturedPart> dividedByTexture(Mesh mesh, std::span<const std::uint32_t> textures);

/// A mesh of triangles with the positions and wedges that it uses, in the order of first use.
Mesh inOrderOfUse(const Mesh& mesh);

/// Gives each part an appearance with its image, and adds it as a shape. Vertex colours of a part with an image are
/// left out: the file has them for viewers that display no textures. Adds warnings of what is left out.
void addTexturedShapes(Imported& imported, std::vector<TexturedPart> parts, const std::vector<std::string>& files,
                       const ImportOptions& options, const std::string& name);

/// Whether `file`, which a comment names, is an image that can be read.
bool isReadablePlyTexture(const std::string& file, const ImportOptions& options, const std::string& name);

} // namespace imgeo
