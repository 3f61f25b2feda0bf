#include "import/mesh/metadata_set.h"

#include "scene/mf_string.h"

#include <fmt/format.h>
#include <utility>

namespace imgeo {

namespace {

std::size_t addElement(SceneGraph& graph, const char* element, std::vector<FieldText> fields) {
  return addNode(
      graph,
      {.name = "", .content = GenericNode{element, "", {}}, .children = {}, .extras = "", .fields = std::move(fields)});
}

} // namespace

void MetadataSet::add(const char* element, const char* name, std::string value) {
  values_.push_back(
      addElement(graph_, element, {{"containerField", "value"}, {"name", name}, {"value", std::move(value)}}));
}

void MetadataSet::addText(const char* name, const std::string& text) {
  if (!text.empty())
    add("MetadataString", name, quoteStrings({text}));
}

void MetadataSet::addPoint(const char* name, const Vec3d& point) {
  add("MetadataDouble", name, fmt::format("{} {} {}", point.x, point.y, point.z));
}

void MetadataSet::addTo(std::size_t node, const char* name) {
  const std::size_t set = addElement(graph_, "MetadataSet", {{"containerField", "metadata"}, {"name", name}});
  graph_.nodes[set].children = std::move(values_);
  values_.clear();
  graph_.nodes[node].children.push_back(set);
}

} // namespace imgeo
