#pragma once
// Textures of PLY files that are read piece by piece: the first piece has the appearance.

#include "import/import.h"
#include "import/ply/header.h"

#include <mutex>
#include <string>

namespace imgeo {

class PlyPieceTextures {
public:
  /// Throws Error{unsupported}, naming `name`, where faces have textures of their own: each would be a shape. `faces`:
  /// nullptr for a cloud. The header must outlive the object.
  PlyPieceTextures(const PlyHeader& header, const PlyElement* faces, const std::string& name);

  /// Lines of the header of a piece.
  std::string comments(bool isFirst) const;
  /// Removes the vertex colours of a piece if those of the first are left out. Safe to call from any thread.
  void followFirst(Imported& piece, const ImportOptions& options) const;

private:
  const PlyHeader& header_;
  bool hasTextures_ = false;
  std::string name_;
  mutable std::once_flag isLookedFor_;
  mutable bool isReadable_ = false;
};

} // namespace imgeo
