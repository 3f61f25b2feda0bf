#pragma once
// The DEF names of the elements of a document.

#include "documents/documents.h"
#include "documents/element_writer.h"
#include "documents/xml_text.h"

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace imgeo {

/// The DEF names of elements, and which of the elements have been written.
class ElementNames {
public:
  explicit ElementNames(std::size_t count) : names_(count), written_(count) {}
  std::string& operator[](std::size_t index) { return names_[index]; }
  /// Returns an element's DEF at the first call and its USE at later ones; nothing for an element without a name.
  Attributes defOrUse(std::size_t index);
  /// Whether defOrUse() has been called for an element with a name.
  bool isWritten(std::size_t index) const { return written_[index]; }

private:
  std::vector<std::string> names_;
  std::vector<bool> written_;
};

/// The url and `solid` of the node of a shared geometry.
using SharedGeometryKey = std::pair<std::string, bool>;

/// `shape`: one whose geometry is shared (GeometryDescription::isShared).
SharedGeometryKey sharedKeyOf(const SceneDocument& document, const Shape& shape);

struct DocumentNames {
  DefNames all; ///< has assigned them, and assigns further ones
  ElementNames nodes, appearances, textures;
  ElementNames geometries;                                   ///< by 2 * mesh + !solid
  std::map<SharedGeometryKey, std::string> sharedGeometries; ///< of their nodes
};

/// Chooses the names of the elements that are written for the nodes below `roots`. Nodes come first, and so keep the
/// names that scripts refer to.
DocumentNames chooseNames(const SceneDocument& document, const std::vector<std::size_t>& roots);

/// Whether the attributes are a USE instead of a DEF.
bool isUse(const Attributes& names);

} // namespace imgeo
