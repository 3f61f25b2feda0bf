#include "import/vrml1/info.h"

#include "import/x3d/field_values.h"
#include "scene/mf_string.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo::vrml1 {

namespace {

/// The X3D navigation type of a viewer's name; empty for unknown ones.
std::string navigationTypeOf(const std::string& viewer) {
  if (viewer == "examiner")
    return "EXAMINE";
  if (viewer == "walk")
    return "WALK";
  return viewer == "fly" || viewer == "plane" ? "FLY" : "";
}

} // namespace

pugi::xml_node navigationInfoOf(x3d::VrmlElements& elements, pugi::xml_node scene, const x3d::Token& where) {
  const pugi::xml_node existing = scene.child("NavigationInfo");
  return existing ? existing : elements.add(scene, "NavigationInfo", where);
}

void addSceneInfo(const Tree& tree, x3d::VrmlElements& elements, pugi::xml_node scene) {
  std::string title;
  std::vector<std::string> notes;
  for (const Node& node : tree.nodes) {
    if (!node.is("Info") || !node.field("string"))
      continue;
    const std::string text = node.word("string", "");
    if (node.name == "BackgroundColor") {
      if (const auto color = x3d::parseReals(text); color && color->size() == 3)
        x3d::set(elements.add(scene, "Background", node.where), "skyColor", text);
    } else if (const std::string type = navigationTypeOf(text); node.name == "Viewer" && !type.empty()) {
      x3d::set(navigationInfoOf(elements, scene, node.where), "type", quoteStrings({type, "ANY"}));
    } else if (node.name == "Title") {
      title = text;
    } else if (!text.empty()) {
      notes.push_back(text);
    }
  }
  if (title.empty() && notes.empty())
    return;
  pugi::xml_node info = elements.add(scene, "WorldInfo", tree.root().where);
  if (!title.empty())
    x3d::set(info, "title", title);
  if (!notes.empty())
    x3d::set(info, "info", quoteStrings(notes));
}

} // namespace imgeo::vrml1
