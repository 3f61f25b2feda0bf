#include "import/vrml/names.h"

#include "import/x3d/node_table.h"

#include <map>
#include <set>

namespace imgeo::x3d {

std::string_view defaultContainerField(std::string_view element) {
  const NodeRow* row = nodeRow(element);
  return row ? row->containerField : "children";
}

std::string_view currentFieldName(std::string_view element, std::string_view field) {
  if ((element == "LOD" && field == "level") || (element == "Switch" && field == "choice"))
    return "children";
  if (element == "Collision" && field == "collide")
    return "enabled";
  return field;
}

bool isStringList(std::string_view element, std::string_view field) {
  static const std::set<std::string_view> lists{"backUrl",        "bottomUrl", "family",  "frontUrl", "function",
                                                "geoSystem",      "info",      "justify", "leftUrl",  "objectType",
                                                "parameter",      "rightUrl",  "source",  "string",   "topUrl",
                                                "transitionType", "url"};
  return lists.contains(field) || (element == "NavigationInfo" && field == "type") ||
         (element == "MetadataString" && field == "value") || (element == "MultiTexture" && field == "mode");
}

bool isNodeList(std::string_view field) {
  static const std::set<std::string_view> lists{"addChildren",    "attrib",  "children", "choice",  "level",
                                                "removeChildren", "shaders", "skin",     "texture", "viewpoints"};
  return lists.contains(field);
}

std::string_view accessTypeOf(std::string_view word) {
  static const std::map<std::string_view, std::string_view> types{
      {"eventIn", "inputOnly"},        {"inputOnly", "inputOnly"},    {"eventOut", "outputOnly"},
      {"outputOnly", "outputOnly"},    {"field", "initializeOnly"},   {"initializeOnly", "initializeOnly"},
      {"exposedField", "inputOutput"}, {"inputOutput", "inputOutput"}};
  const auto found = types.find(word);
  return found == types.end() ? "" : found->second;
}

} // namespace imgeo::x3d
