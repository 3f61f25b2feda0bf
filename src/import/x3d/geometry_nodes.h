#pragma once
// Reads single geometry nodes of an X3D document or a page as meshes, those that the importer leaves in the document
// included.

#include "import/import.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace imgeo {

/// The mesh of a geometry node.
struct NodeMesh {
  Mesh mesh; ///< without corners for a node that draws nothing
  bool solid = true;
};

/// The geometry nodes of one document.
class GeometryNodes {
public:
  /// Those of `options` count that are about vertex attributes and creases. Throws Error as parseX3d().
  GeometryNodes(std::string_view text, const std::string& name, const ImportOptions& options);
  ~GeometryNodes();
  GeometryNodes(const GeometryNodes&) = delete;
  GeometryNodes& operator=(const GeometryNodes&) = delete;

  /// The mesh of the element that stands at byte `offset` of the text, mapped by its operators. Empty where it is no
  /// geometry node that becomes a mesh, such as a Text. Throws Error for a node that importers would leave as it is.
  std::optional<NodeMesh> read(std::size_t offset) const;

private:
  struct Document;
  std::unique_ptr<Document> document_;
};

} // namespace imgeo
