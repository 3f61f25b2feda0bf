#pragma once
// Writes the fields in node_fields.h: texts of values, and elements of nodes.

#include "documents/element_writer.h"
#include "documents/node_fields.h"

namespace imgeo {

inline std::string fieldText(const std::string& value) {
  return value;
}
inline std::string fieldText(bool value) {
  return value ? "true" : "false";
}
inline std::string fieldText(float value) {
  return number(value);
}
inline std::string fieldText(double value) {
  return number(value);
}
template <typename T> std::string fieldText(Vec2<T> value) {
  return numbers(value);
}
template <typename T> std::string fieldText(Vec3<T> value) {
  return numbers(value);
}
inline std::string fieldText(const Rotation& value) {
  return numbers(value.axis) + " " + number(value.angle);
}

/// A visitor that collects the texts of all fields of a node.
struct FieldTexts {
  std::vector<std::string> texts;

  void operator()(const char*, const auto& member, Written = Written::unlessDefault) {
    texts.push_back(fieldText(member));
  }
  void line() {}
};

/// A visitor that adds to an element the attributes of fields that differ from their defaults.
struct FieldAttributes {
  const std::vector<std::string>& defaults;
  Element& element;
  std::size_t next = 0;

  void operator()(const char* name, const auto& member, Written written = Written::unlessDefault) {
    const std::string text = fieldText(member);
    if (written == Written::always || text != defaults[next])
      element.groups.back().push_back({name, text});
    ++next;
  }
  void line() { element.groups.emplace_back(); }
};

/// The element of a node, with its fields as attributes and without children. `names` is its DEF, if any.
template <typename Node> Element nodeElement(const char* name, const Node& node, const Attributes& names = {}) {
  FieldTexts defaults;
  visitFields(Node{}, defaults);
  Element element{name, {names}};
  visitFields(node, FieldAttributes{defaults.texts, element});
  return element;
}

} // namespace imgeo
