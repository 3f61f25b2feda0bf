#pragma once
// Geometry whose vertices are in files beside the document: ImageGeometry, BinaryGeometry, PopGeometry and
// ExternalGeometry, of sites that imgeo or another program has written, such as aopt for X3DOM.

#include "base/error.h"
#include "containers/container_reader.h"
#include "documents/field_reader.h"
#include "import/gltf/shape_resource.h"
#include "import/references.h"
#include "import/x3d/source.h"
#include "scene/mesh.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace imgeo::x3d {

/// Whether elements of this name are such geometry.
bool isContainerGeometry(std::string_view element);

/// The geometry nodes of a Group that convert has written for X3DOM instead of a Shape (docs/formats/x3dom.md): the
/// Group has a box, and a Shape for each patch, all with one Appearance. Empty for other elements.
std::vector<pugi::xml_node> geometriesOfPatches(const Source& source, pugi::xml_node group);

/// Reads the files that the geometry nodes of one document name.
class ContainerGeometries {
public:
  /// `warnings`: see readGeometry().
  ContainerGeometries(const Source& source, const References& references, DocumentWarnings* warnings)
      : source_(source), warnings_(warnings),
        fetch_([&references](const std::string& url) { return references.fetch(url); }), reader_(fetch_) {}

  /// Whether only the front of a geometry's triangles is visible: see readSolid().
  bool isSolid(pugi::xml_node node) const;

  /// The meshes, one for each kind of element, of nodes whose patches belong together, or of one node that is no
  /// ExternalGeometry; empty where nodes differ in more than their patches. Of the named attributes it has those in
  /// `kept`; the names of all are added to `attributes`. `keepsVertices`: see readMesh(). Throws Error with the file
  /// and line of the node or with the url of a file.
  std::optional<std::vector<Mesh>> read(std::span<const pugi::xml_node> nodes, const AttributeChoice& kept,
                                        std::set<std::string>& attributes, bool keepsVertices = false) const;

  /// The mesh of a patch of a node that several Shapes share, or why it cannot be read.
  using SharedPatch = std::variant<Mesh, Error>;

  /// Patches of the file of such a node, by their index, which are decoded together. Throws Error for a node that is no
  /// such one. Otherwise as read().
  std::map<std::uint32_t, SharedPatch> readShared(pugi::xml_node node, const std::set<std::uint32_t>& indices,
                                                  const AttributeChoice& kept, std::set<std::string>& attributes) const;

  /// The content of the first url of an ExternalGeometry or, with its materials, of an ExternalShape that can be read.
  /// Throws the joined Errors of all, or Error{malformed} at the node where it has no url.
  gltf::ShapeResource readExternal(pugi::xml_node node, bool withMaterials) const;

private:
  /// Keeps the named attributes of a mesh that are in `kept`; adds the names of all to `attributes`.
  static void chooseAttributes(Mesh& mesh, const AttributeChoice& kept, std::set<std::string>& attributes);

  GeometryDescription describe(pugi::xml_node node) const;

  const Source& source_;
  DocumentWarnings* warnings_;
  FetchFile fetch_;
  ContainerReader reader_;
};

} // namespace imgeo::x3d
