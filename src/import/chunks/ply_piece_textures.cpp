#include "import/chunks/ply_piece_textures.h"

#include "base/error.h"
#include "import/ply/textures.h"

#include <fmt/format.h>

namespace imgeo {

PlyPieceTextures::PlyPieceTextures(const PlyHeader& header, const PlyElement* faces, const std::string& name)
    : header_(header), hasTextures_(faces && !header.textureFiles.empty()), name_(name) {
  if (hasTextures_ && faces && faces->find("texnumber"))
    throw Error(ErrorKind::unsupported, name,
                "has faces with a 'texnumber', each of which is a shape, and is not read piece by piece");
}

std::string PlyPieceTextures::comments(bool isFirst) const {
  std::string text;
  if (hasTextures_ && isFirst)
    for (const std::string& file : header_.textureFiles)
      text += fmt::format("comment TextureFile {}\n", file);
  return text;
}

void PlyPieceTextures::followFirst(Imported& piece, const ImportOptions& options) const {
  if (!hasTextures_)
    return;
  std::call_once(isLookedFor_,
                 [&] { isReadable_ = isReadablePlyTexture(header_.textureFiles.front(), options, name_); });
  for (Mesh& mesh : piece.scene.meshes)
    if (isReadable_ && !mesh.texCoords.empty())
      mesh.colors.clear();
}

} // namespace imgeo
