#include "import/x3d/shared_appearances.h"

#include <fmt/format.h>
#include <set>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace imgeo::x3d {

namespace {

/// The Appearances of a document in its order, the number of its Shapes, and its DEF names.
struct Survey : pugi::xml_tree_walker {
  bool for_each(pugi::xml_node& node) override {
    const std::string_view name = node.name();
    shapes += name == "Shape";
    if (const pugi::xml_attribute def = node.attribute("DEF")) {
      names.insert(def.value());
      for (pugi::xml_node above = node; above; above = above.parent())
        named.insert(above.internal_object());
    }
    if (name == "Appearance" && !node.attribute("USE"))
      appearances.push_back(node);
    return true;
  }

  std::size_t shapes = 0;
  std::vector<pugi::xml_node> appearances;
  std::set<std::string, std::less<>> names;
  std::set<pugi::xml_node_struct*> named; ///< elements with a DEF, and those around them
};

struct TextWriter : pugi::xml_writer {
  void write(const void* data, std::size_t size) override { text.append(static_cast<const char*>(data), size); }
  std::string text;
};

/// An unused DEF name.
std::string newName(std::set<std::string, std::less<>>& names) {
  std::string name = "Appearance";
  for (std::size_t number = names.size(); !names.insert(name).second; ++number)
    name = fmt::format("Appearance-{}", number);
  return name;
}

} // namespace

std::size_t shareAppearances(Elements& elements) {
  Survey survey;
  elements.document.traverse(survey);
  if (survey.shapes <= maxShapesWithOwnAppearance)
    return 0;
  std::size_t replaced = 0;
  std::unordered_map<std::string, pugi::xml_node> first; // by content
  for (pugi::xml_node appearance : survey.appearances) {
    if (survey.named.contains(appearance.internal_object()))
      continue;
    TextWriter content;
    appearance.print(content, "", pugi::format_raw | pugi::format_no_declaration);
    const auto [found, isNew] = first.try_emplace(std::move(content.text), appearance);
    if (isNew)
      continue;
    pugi::xml_node shared = found->second;
    if (!shared.attribute("DEF"))
      shared.prepend_attribute("DEF").set_value(newName(survey.names).c_str());
    const std::string containerField = appearance.attribute("containerField").value();
    appearance.remove_children();
    appearance.remove_attributes();
    appearance.append_attribute("USE").set_value(shared.attribute("DEF").value());
    if (!containerField.empty())
      appearance.append_attribute("containerField").set_value(containerField.c_str());
    ++replaced;
  }
  return replaced;
}

} // namespace imgeo::x3d
