#include "import/chunks/ply_declaration.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr const char* plyTypeNames[] = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};

} // namespace

std::string declaration(const PlyElement& element, std::uint64_t count) {
  std::string text = fmt::format("element {} {}\n", element.name, count);
  for (const PlyProperty& property : element.properties)
    text += property.isList()
                ? fmt::format("property list {} {} {}\n", plyTypeNames[static_cast<std::size_t>(*property.countType)],
                              plyTypeNames[static_cast<std::size_t>(property.type)], property.name)
                : fmt::format("property {} {}\n", plyTypeNames[static_cast<std::size_t>(property.type)], property.name);
  return text;
}

PlyMeshElements meshElementsOf(const PlyHeader& header, const std::string& name) {
  for (const PlyElement& element : header.elements)
    if (element.count > 0 && (element.name == "edge" || element.name == "tristrips"))
      throw Error(ErrorKind::unsupported, name,
                  fmt::format("has elements '{}', which are not read piece by piece", element.name));
  const PlyElement *vertices = header.find("vertex"), *faces = header.find("face");
  if (!vertices || vertices->count == 0)
    throw Error(ErrorKind::unsupported, name, "has no vertices that are read piece by piece");
  if (vertices->count > UINT32_MAX)
    throw Error(ErrorKind::limit, name, "has more vertices than 32-bit indices can name");
  if (!faces || faces->count == 0)
    return {vertices, nullptr};
  if (faces < vertices)
    throw Error(ErrorKind::unsupported, name, "has its faces before its vertices, and is not read piece by piece");
  if (std::ranges::count_if(faces->properties, isListOfVertices) != 1)
    throw Error(ErrorKind::malformed, name, "'face' has not one list 'vertex_indices'");
  for (const PlyProperty& property : faces->properties)
    if (isListOfVertices(property) && !isInteger(property.type))
      throw Error(ErrorKind::malformed, name, "vertex_indices are of a type that has fractions");
  return {vertices, faces};
}

} // namespace imgeo
