#pragma once
// For tests: X3D nodes, written in each encoding.

#include "import/x3d/node_table.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo::x3d::testing {

enum class DocumentEncoding { xml, vrml, json };

inline constexpr std::array encodings{DocumentEncoding::xml, DocumentEncoding::vrml, DocumentEncoding::json};

/// A field's value. `text` is that of the XML encoding; of strings, one of them.
struct FieldSample {
  enum class Type { number, numbers, boolean, string, strings };

  std::string name;
  Type type = Type::numbers;
  std::string text;
};

/// A node with its fields. `field` is the field of its parent that it is a value of.
struct NodeSample {
  std::string name;
  std::string field = "children";
  std::string def, use;
  std::vector<FieldSample> fields;
  std::vector<NodeSample> children;
};

/// Whether a field with this name is a list of nodes; others hold one node.
inline bool isListOfNodes(std::string_view field) {
  static constexpr std::array lists{
      std::string_view("attrib"),   std::string_view("bodies"),   std::string_view("collidables"),
      std::string_view("children"), std::string_view("contacts"), std::string_view("displacers"),
      std::string_view("effects"),  std::string_view("joints"),   std::string_view("layers"),
      std::string_view("motions"),  std::string_view("parts"),    std::string_view("physics"),
      std::string_view("programs"), std::string_view("shaders"),  std::string_view("trimmingContour")};
  return std::ranges::find(lists, field) != lists.end();
}

inline std::string defaultFieldOf(const std::string& element) {
  const NodeRow* row = nodeRow(element);
  return row ? std::string(row->containerField) : "children";
}

inline std::string xmlOf(const NodeSample& node) {
  using enum FieldSample::Type;
  std::string text = "<" + node.name;
  if (!node.def.empty())
    text += " DEF='" + node.def + "'";
  if (!node.use.empty())
    text += " USE='" + node.use + "'";
  if (node.field != defaultFieldOf(node.name))
    text += " containerField='" + node.field + "'";
  for (const FieldSample& field : node.fields)
    text += " " + field.name + "='" + (field.type == strings ? "\"" + field.text + "\"" : field.text) + "'";
  if (node.children.empty())
    return text + "/>\n";
  text += ">\n";
  for (const NodeSample& child : node.children)
    text += xmlOf(child);
  return text + "</" + node.name + ">\n";
}

inline std::string vrmlOf(const NodeSample& node) {
  using enum FieldSample::Type;
  if (!node.use.empty())
    return "USE " + node.use + "\n";
  std::string text = (node.def.empty() ? "" : "DEF " + node.def + " ") + node.name + " {\n";
  for (const FieldSample& field : node.fields) {
    const bool isTrue = field.text == "true";
    text += field.name + " " +
            (field.type == numbers   ? "[" + field.text + "]"
             : field.type == boolean ? (isTrue ? "TRUE" : "FALSE")
             : field.type == string  ? "\"" + field.text + "\""
             : field.type == strings ? "[\"" + field.text + "\"]"
                                     : field.text) +
            "\n";
  }
  std::vector<std::string> written;
  for (const NodeSample& first : node.children)
    if (std::ranges::find(written, first.field) == written.end()) {
      written.push_back(first.field);
      const bool isList = isListOfNodes(first.field);
      text += first.field + (isList ? " [\n" : " ");
      for (const NodeSample& child : node.children)
        if (child.field == first.field)
          text += vrmlOf(child);
      text += isList ? "]\n" : "";
    }
  return text + "}\n";
}

inline std::string jsonOf(const NodeSample& node) {
  using enum FieldSample::Type;
  std::string text = "{\"" + node.name + "\": {";
  auto add = [&, isFirst = true](const std::string& key, const std::string& value) mutable {
    text += (isFirst ? "\n\"" : ",\n\"") + key + "\": " + value;
    isFirst = false;
  };
  if (!node.def.empty())
    add("@DEF", "\"" + node.def + "\"");
  if (!node.use.empty())
    add("@USE", "\"" + node.use + "\"");
  for (const FieldSample& field : node.fields) {
    std::string list = field.text;
    std::ranges::replace(list, ' ', ',');
    add("@" + field.name, field.type == numbers   ? "[" + list + "]"
                          : field.type == string  ? "\"" + field.text + "\""
                          : field.type == strings ? "[\"" + field.text + "\"]"
                                                  : field.text);
  }
  std::vector<std::string> written;
  for (const NodeSample& first : node.children)
    if (std::ranges::find(written, first.field) == written.end()) {
      written.push_back(first.field);
      std::string values;
      for (const NodeSample& child : node.children)
        if (child.field == first.field)
          values += (values.empty() ? "" : ",\n") + jsonOf(child);
      add("-" + first.field, isListOfNodes(first.field) ? "[" + values + "]" : values);
    }
  return text + "}}";
}

/// A document of these nodes.
inline std::string documentOf(const std::vector<NodeSample>& nodes, DocumentEncoding encoding) {
  std::string text;
  for (const NodeSample& node : nodes)
    text += encoding == DocumentEncoding::xml    ? xmlOf(node)
            : encoding == DocumentEncoding::vrml ? vrmlOf(node)
                                                 : (text.empty() ? "" : ",\n") + jsonOf(node);
  if (encoding == DocumentEncoding::xml)
    return "<X3D profile='Full' version='4.0'><Scene>\n" + text + "</Scene></X3D>";
  if (encoding == DocumentEncoding::vrml)
    return "#X3D V4.0 utf8\nPROFILE Full\n" + text;
  return "{\"X3D\": {\"@profile\": \"Full\", \"@version\": \"4.0\", \"Scene\": {\"-children\": [\n" + text + "]}}}";
}

/// A name for the document's file.
inline std::string fileNameOf(DocumentEncoding encoding) {
  return encoding == DocumentEncoding::xml ? "all.x3d" : encoding == DocumentEncoding::vrml ? "all.x3dv" : "all.x3dj";
}

inline NodeSample triangleCoordinates() {
  return {"Coordinate", "coord", "", "", {{"point", FieldSample::Type::numbers, "0 0 0 1 0 0 0 1 0"}}, {}};
}

/// A node of a row, within the parents that its field needs.
inline NodeSample sampleOf(const NodeRow& row) {
  using enum FieldSample::Type;
  const std::string field(row.containerField);
  NodeSample node{std::string(row.name), field, "", "", {}, {}};
  if (row.name == "Coordinate" || row.name == "CoordinateDouble")
    node = triangleCoordinates(), node.name = row.name;
  if (row.name == "IndexedFaceSet")
    node.fields = {{"coordIndex", numbers, "0 1 2 -1"}}, node.children = {triangleCoordinates()};
  const auto within = [&](const char* parent, const char* parentField) {
    node = {parent, parentField, "", "", {}, {std::move(node)}};
  };
  static constexpr std::array ofAppearance{"acousticProperties", "effects",          "fillProperties", "lineProperties",
                                           "material",           "pointProperties",  "shaders",        "texture",
                                           "textureTransform",   "textureProperties"};
  static constexpr std::array ofGeometry{"attrib", "color", "coord", "fogCoord", "normal", "texCoord"};
  if (field == "fontStyle") {
    within("Text", "geometry");
  } else if (std::ranges::find(ofGeometry, field) != ofGeometry.end()) {
    within("TriangleSet", "geometry");
    if (field != "coord")
      node.children.push_back(triangleCoordinates());
  } else if (field == "textureProperties") {
    within("PixelTexture", "texture");
  }
  if (std::ranges::find(ofAppearance, node.field) != ofAppearance.end())
    within("Appearance", "appearance");
  if (node.field == "appearance")
    within("Shape", "children"), node.children.push_back({"Box", "geometry", "", "", {}, {}});
  if (node.field == "geometry")
    within("Shape", "children");
  if (node.field != "children")
    within("Group", "children");
  return node;
}

} // namespace imgeo::x3d::testing
