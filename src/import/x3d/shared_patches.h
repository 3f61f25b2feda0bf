#pragma once
// Shapes whose geometry is a patch of a node that they share: the field `patch` of Shape in docs/formats/nodes.md.

#include "import/x3d/container_geometry.h"
#include "import/x3d/source.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace imgeo::x3d {

/// Whether a Shape has such a geometry: the field, and no geometry of its own.
bool hasSharedPatch(const Source& source, pugi::xml_node shape);

/// Reads the patches that the Shapes of one document name. Those of a node are read together and in the order of its
/// file, which is another one than that of the Shapes: reading each for itself would decode files repeatedly.
class SharedPatches {
public:
  /// Makes a mesh a part of the scene. `solid` is the field of the geometry node.
  using AddShape = std::function<Shape(Mesh mesh, bool solid)>;

  /// Everything must outlive this. `kept`, `attributes`: see ContainerGeometries::read.
  SharedPatches(const Source& source, const ContainerGeometries& containers, const AttributeChoice& kept,
                std::set<std::string>& attributes, AddShape addShape)
      : source_(source), containers_(containers), kept_(kept), attributes_(attributes), addShape_(std::move(addShape)) {
  }

  /// The shape of a Shape that hasSharedPatch(); all that name the same patch have one mesh. Empty where the field
  /// names no patch, or one that cannot be read, which is noted; if `isStrict`, throws Error at the Shape instead.
  std::optional<Shape> shapeOf(pugi::xml_node element, bool isStrict);

  /// Adds a warning for each geometry node of which patches are missing, and one for all names of no node.
  void addTo(std::vector<std::string>& warnings) const;

private:
  struct GeometryNode {
    std::set<std::uint32_t> indices; ///< of the patches that Shapes name
    std::map<std::uint32_t, std::variant<Shape, Error>> shapes;
  };
  struct Missing {
    std::size_t count = 0;
    std::string location, reason; ///< of the first Shape
  };

  void findNames();
  void readNode(pugi::xml_node geometry, GeometryNode& node);

  const Source& source_;
  const ContainerGeometries& containers_;
  const AttributeChoice& kept_;
  std::set<std::string>& attributes_;
  AddShape addShape_;
  bool hasNames_ = false;                     ///< findNames() was called
  std::map<std::string, GeometryNode> nodes_; ///< by DEF
  std::map<std::string, Missing> missing_;    ///< by DEF; "" for names of no node
};

} // namespace imgeo::x3d
