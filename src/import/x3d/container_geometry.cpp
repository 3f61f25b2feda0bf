#include "import/x3d/container_geometry.h"

#include "containers/read_mesh.h"
#include "documents/geometry_reader.h"

namespace imgeo::x3d {

bool isContainerGeometry(std::string_view element) {
  return element == "ImageGeometry" || element == "BinaryGeometry";
}

Mesh ContainerGeometries::read(pugi::xml_node node, const AttributeChoice& kept,
                               std::set<std::string>& attributes) const {
  const GeometryDescription geometry = readGeometry(source_.documentText(), node);
  Mesh mesh = readMesh(reader_, geometry, source_.locationOf(node));
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    attributes.insert(attribute.name);
  std::erase_if(mesh.namedAttributes, [&](const NamedAttribute& attribute) { return !kept.has(attribute.name); });
  return mesh;
}

} // namespace imgeo::x3d
