#include "import/chunks/ply_declaration.h"

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

} // namespace imgeo
