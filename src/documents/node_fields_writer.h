#pragma once
// Values of fields -> their text, and the visitor that collects a node's attributes.

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

/// The texts of all fields of a node, in their order.
struct FieldTexts {
  std::vector<std::string> texts;

  void operator()(const char*, const auto& member, Written = Written::unlessDefault) {
    texts.push_back(fieldText(member));
  }
  void line() {}
};

/// The attributes of fields that are not what an absent one means.
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

/// The element of a node that holds nothing but fields.
template <typename Node> Element nodeElement(const char* name, const Node& node, const Attributes& names = {}) {
  FieldTexts defaults;
  visitFields(Node{}, defaults);
  Element element{name, {names}};
  visitFields(node, FieldAttributes{defaults.texts, element});
  return element;
}

} // namespace imgeo
