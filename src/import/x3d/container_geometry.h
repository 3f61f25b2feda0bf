#pragma once
// Geometry whose vertices are in files beside the document: ImageGeometry and BinaryGeometry, of sites that imgeo or
// another program has written, such as aopt for X3DOM.

#include "containers/container_reader.h"
#include "import/references.h"
#include "import/x3d/source.h"
#include "scene/mesh.h"

#include <set>

namespace imgeo::x3d {

/// Whether elements of this name are such geometry.
bool isContainerGeometry(std::string_view element);

/// Reads the files that the geometry nodes of one document name.
class ContainerGeometries {
public:
  ContainerGeometries(const Source& source, const References& references)
      : source_(source), reader_([&references](const std::string& url) { return references.fetch(url); }) {}

  /// The mesh of a node. Of the named attributes it has those in `kept`; the names of all are added to `attributes`.
  /// Throws Error with the file and line of the node or with the url of a file.
  Mesh read(pugi::xml_node node, const AttributeChoice& kept, std::set<std::string>& attributes) const;

private:
  const Source& source_;
  ContainerReader reader_;
};

} // namespace imgeo::x3d
