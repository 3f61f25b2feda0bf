#include "documents/scene_writer.h"

#include "containers/encodings.h"
#include "documents/appearance_element.h"
#include "documents/find_x3d.h"
#include "documents/geometry_element.h"
#include "documents/node_fields_writer.h"
#include "documents/page_sanitizer.h"

#include <algorithm>

namespace imgeo {

namespace {

Element contentElement(const Group&, const Attributes& names) {
  return {"Group", {names}};
}
Element contentElement(const Transform& transform, const Attributes& names) {
  return nodeElement("Transform", transform, names);
}
Element contentElement(const Shape&, const Attributes& names) {
  return {"Shape", {names}};
}
Element contentElement(const Viewpoint& viewpoint, const Attributes& names) {
  return nodeElement("Viewpoint", viewpoint, names);
}
Element contentElement(const OrthoViewpoint& viewpoint, const Attributes& names) {
  Element element = nodeElement("OrthoViewpoint", viewpoint, names);
  element.groups.back().push_back({"fieldOfView", numbers(viewpoint.min) + " " + numbers(viewpoint.max)});
  return element;
}
Element contentElement(const DirectionalLight& light, const Attributes& names) {
  return nodeElement("DirectionalLight", light, names);
}
Element contentElement(const PointLight& light, const Attributes& names) {
  return nodeElement("PointLight", light, names);
}
Element contentElement(const SpotLight& light, const Attributes& names) {
  return nodeElement("SpotLight", light, names);
}

/// A name for something that has none and is used more than once.
std::string wishFor(const std::string& name, std::size_t uses, const char* otherwise) {
  return !name.empty() || uses < 2 ? name : otherwise;
}

} // namespace

bool isUse(const Attributes& names) {
  return !names.empty() && names[0].name == "USE";
}

Attributes SceneWriter::Names::defOrUse(std::size_t index) {
  if (names_[index].empty())
    return {};
  const bool wasWritten = written_[index];
  written_[index] = true;
  return {{wasWritten ? "USE" : "DEF", names_[index]}};
}

SceneWriter::SceneWriter(const SceneDocument& document, std::size_t level, DocumentKind medium,
                         std::optional<std::size_t> inlineNode)
    : document_(document), writer_(level), nodeNames_(document.graph.nodes.size()),
      appearanceNames_(document.graph.appearances.size()), textureNames_(document.graph.textures.size()),
      roots_(inlineNode ? document.graph.nodes.at(*inlineNode).children : document.graph.roots),
      head_(inlineNode ? inlinedDocumentOf(document.graph, *inlineNode).head : document.graph.head), medium_(medium),
      geometryNames_(2 * document.geometries.size()) {
  giveNames();
}

/// Nodes first: scripts look for the names of things that are seen.
void SceneWriter::giveNames() {
  const SceneGraph& graph = document_.graph;
  std::vector<std::size_t> nodeUses(graph.nodes.size()), appearanceUses(graph.appearances.size()),
      textureUses(graph.textures.size()), geometryUses(2 * document_.geometries.size());
  const std::vector<std::size_t> order = nodesOfDocument(graph, roots_);
  for (const std::size_t root : roots_)
    ++nodeUses[root];
  for (const std::size_t index : order) {
    if (!inlinesDocument(graph.nodes[index]))
      for (const std::size_t child : graph.nodes[index].children)
        ++nodeUses[child];
    if (const Shape* shape = std::get_if<Shape>(&graph.nodes[index].content)) {
      ++geometryUses.at(2 * shape->mesh + !shape->solid);
      if (shape->appearance && appearanceUses.at(*shape->appearance)++ == 0)
        for (const TextureUse& use : graph.appearances[*shape->appearance].textures)
          ++textureUses.at(use.texture);
    }
  }
  for (const std::size_t index : order) {
    const Node& node = graph.nodes[index];
    nodeNames_[index] = table_.take(wishFor(node.name, nodeUses[index], "shared"));
  }
  for (std::size_t i = 0; i < appearanceUses.size(); ++i)
    if (appearanceUses[i] > 0)
      appearanceNames_[i] = table_.take(wishFor(graph.appearances[i].name, appearanceUses[i], "look"));
  for (std::size_t i = 0; i < textureUses.size(); ++i)
    textureNames_[i] = textureUses[i] < 2 ? "" : table_.take(wishFor(graph.textures[i].name, 2, "texture"));
  for (std::size_t i = 0; i < geometryUses.size(); ++i)
    geometryNames_[i] = geometryUses[i] < 2 ? "" : table_.take("geometry");
}

/// Whether the source brings an element of its own.
bool SceneWriter::hasOther(std::string_view element) const {
  return std::ranges::any_of(document_.graph.nodes, [&](const Node& node) {
    const GenericNode* other = std::get_if<GenericNode>(&node.content);
    return other && other->element == element;
  });
}

void SceneWriter::writeHead() {
  const SceneGraph& graph = document_.graph;
  if (graph.isComplete)
    return;
  if ((!graph.title.empty() || !graph.info.empty()) && !hasOther("WorldInfo")) {
    Attributes fields{{"title", graph.title}};
    if (!graph.info.empty())
      fields.push_back({"info", strings(graph.info)});
    writer_.leaf({"WorldInfo", {fields}});
  }
  if (!hasOther("NavigationInfo"))
    writer_.leaf({"NavigationInfo", {{{"headlight", fieldText(graph.headlight)}}}});
  if (graph.background)
    writer_.leaf({"Background", {{{"skyColor", numbers(graph.background->skyColor)}}}});
}

/// What an X3D file says of itself; HTML has a head of its own.
void SceneWriter::writeHeader() {
  if (head_.header.empty() || medium_ == DocumentKind::page)
    return;
  const Element head{"head", {}};
  writer_.open(head);
  for (const std::size_t node : head_.header)
    writeNode(node);
  writer_.close(head);
}

std::string SceneWriter::write() {
  Element x3d{"X3D", {{{"profile", "Interchange"}, {"version", "4.0"}}}};
  if (!head_.fields.empty())
    x3d.groups = {allowedFields(head_.fields)};
  const Element scene{"Scene", {}};
  writer_.open(x3d);
  writeHeader();
  writer_.open(scene);
  writeHead();
  for (const std::size_t root : roots_)
    writeNode(root);
  writer_.close(scene);
  writer_.close(x3d);
  return writer_.text();
}

void SceneWriter::writeExtras(const Node& node) {
  if (!node.extras.empty())
    writer_.leaf(
        {"MetadataString", {{{"containerField", "metadata"}, {"name", "extras"}, {"value", strings({node.extras})}}}});
}

void SceneWriter::writeChildren(const Node& node) {
  writeExtras(node);
  for (const std::size_t child : node.children)
    writeNode(child);
}

Attributes SceneWriter::furtherFields(const Node& node) const {
  return allowedFields(node.fields);
}

Attributes SceneWriter::allowedFields(const std::vector<FieldText>& all) const {
  Attributes fields;
  for (const FieldText& field : all) {
    if (medium_ == DocumentKind::file) {
      fields.push_back({field.name, field.value});
      continue;
    }
    if (!isInertAttribute(field.name))
      continue;
    const bool isUrl = equalIgnoringCase(field.name, "url") || field.name.ends_with("Url");
    const std::string value = isUrl ? safeUrls(field.value) : field.value;
    if (!isUrl || !value.empty())
      fields.push_back({field.name, value});
  }
  return fields;
}

Attribute SceneWriter::fontStyleAttribute(const std::string& style) const {
  return {"data-style", style};
}

/// A page has a Group where it may not have an element that others stand in.
Element SceneWriter::otherElement(const GenericNode& other, const Node& node, const Attributes& names) const {
  const bool isWritten = medium_ == DocumentKind::file || isAllowedInPage(other.element);
  Element element{isWritten ? other.element : "Group", {names}};
  if (!isWritten)
    return element;
  const ImageFile* image = other.image ? &document_.graph.images.at(*other.image) : nullptr;
  for (Attribute& field : furtherFields(node)) {
    if (field.name == "preview" && image)
      continue; // of the image that was found under the source's url
    if (field.name == "url" && image)
      field.value = strings({image->url});
    if (field.name == "url" && other.document)
      field.value = strings({document_.graph.inlined.at(*other.document).url});
    element.groups.back().push_back(std::move(field));
  }
  if (medium_ == DocumentKind::page && other.element == "FontStyle")
    for (const FieldText& field : node.fields)
      if (field.name == "style")
        element.groups.back().push_back(fontStyleAttribute(field.value));
  if (image && !image->preview.empty())
    element.groups.back().push_back({"preview", image->preview});
  return element;
}

Element SceneWriter::elementOf(const Node& node, const Attributes& names) const {
  if (const GenericNode* other = std::get_if<GenericNode>(&node.content))
    return otherElement(*other, node, names);
  Element element = std::visit(
      [&](const auto& content) {
        if constexpr (std::is_same_v<decltype(content), const GenericNode&>)
          return Element{};
        else
          return contentElement(content, names);
      },
      node.content);
  Attributes further = furtherFields(node); // an X3D source's own words come before ours
  std::erase_if(element.groups.back(), [&](const Attribute& attribute) {
    return std::ranges::find(further, attribute.name, &Attribute::name) != further.end();
  });
  std::ranges::move(further, std::back_inserter(element.groups.back()));
  return element;
}

/// In a page comments are left out: HTML ends some of them sooner than XML.
void SceneWriter::writeComment(const GenericNode& comment) {
  if (medium_ == DocumentKind::file)
    writer_.comment(comment.text);
}

void SceneWriter::writeNode(std::size_t index) {
  const Node& node = document_.graph.nodes[index];
  const GenericNode* other = std::get_if<GenericNode>(&node.content);
  if (other && other->element == commentElement)
    return writeComment(*other);
  if (other && medium_ == DocumentKind::page && node.children.empty() && !isAllowedInPage(other->element))
    return;
  const Attributes names = nodeNames_.defOrUse(index);
  if (isUse(names))
    return writer_.leaf({elementOf(node, {}).name, {names}});
  if (std::holds_alternative<Shape>(node.content))
    return writeShape(node, names);
  const Element element = elementOf(node, names);
  if ((node.children.empty() || inlinesDocument(node)) && node.extras.empty())
    return writer_.leaf(element, other && medium_ == DocumentKind::file ? other->text : "");
  writer_.open(element);
  writeChildren(node);
  writer_.close(element);
}

void SceneWriter::writeAppearanceOf(const Shape& shape) {
  if (!shape.appearance)
    return;
  const Attributes names = appearanceNames_.defOrUse(*shape.appearance);
  if (isUse(names))
    return writer_.leaf({"Appearance", {names}});
  writeAppearance(writer_, document_.graph, document_.graph.appearances.at(*shape.appearance), names,
                  [&](std::size_t texture) { return textureNames_.defOrUse(texture); });
}

void SceneWriter::writeGeometryOf(const Shape& shape) {
  const GeometryDescription& geometry = document_.geometries.at(shape.mesh);
  const Attributes names = geometryNames_.defOrUse(2 * shape.mesh + !shape.solid);
  if (isUse(names))
    return writer_.leaf({rowOf(geometry).node.name, {names}});
  const Element node = geometryElement(geometry, shape.solid, names);
  const bool hasPatchElements = !isSinglePatch(geometry);
  if (geometry.attributes.empty() && !hasPatchElements)
    return writer_.leaf(node);
  writer_.open(node);
  for (const AttributeDescription& attribute : geometry.attributes)
    writer_.leaf(vertexAttributeElement(attribute, geometry.encoding));
  for (std::size_t i = 0; i < geometry.patches.size() && hasPatchElements; ++i)
    writer_.leaf(patchElement(geometry.patches[i], geometry));
  writer_.close(node);
}

void SceneWriter::writeShape(const Node& node, const Attributes& names) {
  const Shape& shape = std::get<Shape>(node.content);
  const GeometryDescription& geometry = document_.geometries.at(shape.mesh);
  const Element element{"Shape", {names, furtherFields(node), boxAttributes(geometry.box, geometry.lattice)}};
  writer_.open(element);
  writeChildren(node);
  writeAppearanceOf(shape);
  writeGeometryOf(shape);
  writer_.close(element);
}

} // namespace imgeo
