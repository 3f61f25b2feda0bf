#include "documents/scene_writer.h"

#include "containers/encodings.h"
#include "documents/animation_element.h"
#include "documents/appearance_element.h"
#include "documents/content_element.h"
#include "documents/geometry_element.h"
#include "documents/node_fields_writer.h"
#include "documents/page_sanitizer.h"
#include "documents/skin_element.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <set>

namespace imgeo {

namespace {

/// Documents of more nodes are for programs to read: their indentation would be a fifth of the text.
constexpr std::size_t maxReadableNodes = 10'000;

TextLayout layoutOf(const SceneGraph& graph, DocumentKind kind) {
  if (graph.nodes.size() <= maxReadableNodes)
    return TextLayout::readable;
  return kind == DocumentKind::file ? TextLayout::denseXml : TextLayout::dense;
}

const std::vector<std::size_t>& rootsOf(const SceneGraph& graph, std::optional<std::size_t> inlineNode) {
  return inlineNode ? graph.nodes.at(*inlineNode).children : graph.roots;
}

} // namespace

SceneWriter::SceneWriter(const SceneDocument& document, std::size_t level, DocumentKind kind,
                         std::optional<std::size_t> inlineNode)
    : document_(document), writer_(level, layoutOf(document.graph, kind)),
      names_(chooseNames(document, rootsOf(document.graph, inlineNode))), roots_(rootsOf(document.graph, inlineNode)),
      head_(inlineNode ? inlinedDocumentOf(document.graph, *inlineNode).head : document.graph.head), kind_(kind) {}

/// Writes the geometry nodes whose patches are shapes. They are no child of any of these shapes, so that each can be
/// removed.
void SceneWriter::writeSharedGeometries() {
  std::set<SharedGeometryKey> written;
  if (names_.sharedGeometries.empty())
    return;
  for (const std::size_t index : nodesOfDocument(document_.graph, roots_))
    if (const Shape* shape = std::get_if<Shape>(&document_.graph.nodes[index].content))
      if (const GeometryDescription& geometry = document_.geometries[shape->mesh]; geometry.isShared)
        if (const auto key = sharedKeyOf(document_, *shape); written.insert(key).second)
          writer_.leaf(sharedGeometryElement(geometry, shape->solid, {{"DEF", names_.sharedGeometries.at(key)}}));
}

/// Whether the source has an element of this name.
bool SceneWriter::hasGenericNode(std::string_view element) const {
  return std::ranges::any_of(document_.graph.nodes, [&](const Node& node) {
    const GenericNode* generic = std::get_if<GenericNode>(&node.content);
    return generic && generic->element == element;
  });
}

void SceneWriter::writeSceneSettings() {
  const SceneGraph& graph = document_.graph;
  if (graph.isComplete)
    return;
  if ((!graph.title.empty() || !graph.info.empty()) && !hasGenericNode("WorldInfo")) {
    Attributes fields{{"title", graph.title}};
    if (!graph.info.empty())
      fields.push_back({"info", quoteStrings(graph.info)});
    writer_.leaf({"WorldInfo", {fields}});
  }
  if (!hasGenericNode("NavigationInfo"))
    writer_.leaf({"NavigationInfo", {{{"headlight", fieldText(graph.headlight)}}}});
  if (graph.background)
    writer_.leaf({"Background", {{{"skyColor", numbers(graph.background->skyColor)}}}});
}

/// Writes the <head> of an X3D file; in a page it would collide with HTML's <head>.
void SceneWriter::writeFileHead() {
  if (head_.header.empty() || kind_ == DocumentKind::page)
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
  writeFileHead();
  writer_.open(scene);
  writeSceneSettings();
  writeSharedGeometries();
  for (const std::size_t root : roots_)
    writeNode(root);
  writeRoutes();
  writer_.close(scene);
  writer_.close(x3d);
  return writer_.text();
}

/// Writes the routes between nodes of this document. They stand behind all nodes, as HTML parsers and X3DOM need it.
void SceneWriter::writeRoutes() {
  for (const Route& route : document_.graph.routes)
    if (names_.nodes.isWritten(route.fromNode) && names_.nodes.isWritten(route.toNode))
      writer_.leaf(routeElement(route, names_.nodes[route.fromNode], names_.nodes[route.toNode]));
}

void SceneWriter::writeExtras(const Node& node) {
  if (!node.extras.empty())
    writer_.leaf({"MetadataString",
                  {{{"containerField", "metadata"}, {"name", "extras"}, {"value", quoteStrings({node.extras})}}}});
}

void SceneWriter::writeChildren(const Node& node) {
  writeExtras(node);
  if (const Humanoid* humanoid = std::get_if<Humanoid>(&node.content))
    for (const std::size_t joint : humanoid->joints)
      writer_.leaf(jointElement(names_.nodes[joint]));
  for (const std::size_t child : node.children)
    if (!hasFrames(document_.graph.nodes[child]))
      writeNode(child);
}

Attributes SceneWriter::furtherFields(const Node& node) const {
  return allowedFields(node.fields);
}

Attributes SceneWriter::allowedFields(const std::vector<FieldText>& candidates) const {
  Attributes fields;
  for (const FieldText& field : candidates) {
    if (kind_ == DocumentKind::file) {
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

/// In a page an element that is not allowed, but has children, becomes a Group.
Element SceneWriter::genericElement(const GenericNode& generic, const Node& node, const Attributes& names) const {
  const bool isWritten = kind_ == DocumentKind::file || isAllowedInPage(generic.element);
  Element element{isWritten ? generic.element : "Group", {names}};
  if (!isWritten)
    return element;
  std::vector<FieldText> fields = node.fields;
  std::string preview;
  for (const FieldImage& each : generic.images) {
    const ImageFile& image = document_.graph.images.at(each.image);
    for (FieldText& field : fields)
      if (field.name == each.field)
        field.value = quoteStrings({image.url});
    if (generic.element == "ImageTexture")
      preview = image.preview;
  }
  if (!generic.images.empty()) // another image has another preview
    std::erase_if(fields, [](const FieldText& field) { return field.name == "preview"; });
  for (Attribute& field : allowedFields(fields)) {
    if (field.name == "url" && generic.document)
      field.value = quoteStrings({document_.graph.inlined.at(*generic.document).url});
    element.groups.back().push_back(std::move(field));
  }
  if (kind_ == DocumentKind::page && generic.element == "FontStyle")
    for (const FieldText& field : node.fields)
      if (field.name == "style")
        element.groups.back().push_back(fontStyleAttribute(field.value));
  if (!preview.empty())
    element.groups.back().push_back({"preview", preview});
  return element;
}

Element SceneWriter::elementOf(const Node& node, const Attributes& names) const {
  if (const GenericNode* generic = std::get_if<GenericNode>(&node.content))
    return genericElement(*generic, node, names);
  Element element = contentElement(node.content, names);
  Attributes further = furtherFields(node); // attributes of an X3D source replace ours
  std::erase_if(element.groups.back(), [&](const Attribute& attribute) {
    return std::ranges::find(further, attribute.name, &Attribute::name) != further.end();
  });
  std::ranges::move(further, std::back_inserter(element.groups.back()));
  return element;
}

/// Comments are left out of pages, since HTML ends some of them earlier than XML.
void SceneWriter::writeComment(const GenericNode& comment) {
  if (kind_ == DocumentKind::file)
    writer_.comment(comment.text);
}

void SceneWriter::writeNode(std::size_t index) {
  const Node& node = document_.graph.nodes[index];
  const GenericNode* generic = std::get_if<GenericNode>(&node.content);
  if (generic && generic->element == commentElement)
    return writeComment(*generic);
  if (generic && kind_ == DocumentKind::page && node.children.empty() && !isAllowedInPage(generic->element))
    return;
  const Attributes names = names_.nodes.defOrUse(index);
  if (isUse(names))
    return writer_.leaf({elementOf(node, {}).name, {names}});
  if (std::holds_alternative<Shape>(node.content))
    return writeShape(node, names);
  const Element element = elementOf(node, names);
  if ((node.children.empty() || inlinesDocument(node)) && node.extras.empty())
    return writer_.leaf(element, generic && kind_ == DocumentKind::file ? generic->text : "");
  writer_.open(element);
  writeChildren(node);
  writer_.close(element);
}

void SceneWriter::writeAppearanceOf(const Shape& shape) {
  if (!shape.appearance)
    return;
  const Attributes names = names_.appearances.defOrUse(*shape.appearance);
  if (isUse(names))
    return writer_.leaf({"Appearance", {names}});
  writeAppearance(writer_, document_.graph, document_.graph.appearances.at(*shape.appearance), names,
                  [&](std::size_t texture) { return names_.textures.defOrUse(texture); });
}

/// `node`: the Shape. The interpolator that has the frames of its vertices is a child of the geometry's element.
void SceneWriter::writeGeometryOf(const Node& node) {
  const Shape& shape = std::get<Shape>(node.content);
  const GeometryDescription& geometry = document_.geometries.at(shape.mesh);
  const Attributes names = names_.geometries.defOrUse(2 * shape.mesh + !shape.solid);
  if (isUse(names))
    return writer_.leaf({rowOf(geometry).node.name, {names}});
  const std::optional<Attributes> ownBox = boxInGeometry(geometry);
  Element element = geometryElement(geometry, shape.solid, names, ownBox);
  if (!shape.movingBox.empty() && !ownBox) // the Shape has another one
    element.groups.push_back(boxAttributes(geometry.box, geometry.lattice));
  const bool hasPatchElements = !isSinglePatch(geometry) && !geometry.levels;
  if (geometry.attributes.empty() && !hasPatchElements)
    return writer_.leaf(element);
  writer_.open(element);
  for (const std::size_t child : node.children)
    if (hasFrames(document_.graph.nodes[child]))
      writeNode(child);
  for (const AttributeDescription& attribute : geometry.attributes)
    writer_.leaf(vertexAttributeElement(attribute, geometry.encoding));
  for (std::size_t i = 0; i < geometry.patches.size() && hasPatchElements; ++i)
    writer_.leaf(patchElement(geometry.patches[i], geometry));
  writer_.close(element);
}

/// The box where the geometry's element has it, instead of the Shape: in dense documents.
std::optional<Attributes> SceneWriter::boxInGeometry(const GeometryDescription& geometry) const {
  return writer_.layout() == TextLayout::readable ? std::nullopt : boxWithLattice(geometry);
}

void SceneWriter::writeShape(const Node& node, const Attributes& names) {
  const Shape& shape = std::get<Shape>(node.content);
  const GeometryDescription& geometry = document_.geometries.at(shape.mesh);
  Element element{"Shape", {names, furtherFields(node)}};
  if (geometry.isShared)
    element.groups.push_back(
        {{"patch", patchReference(geometry, names_.sharedGeometries.at(sharedKeyOf(document_, shape)))}});
  else if (!shape.movingBox.empty() || !boxInGeometry(geometry))
    element.groups.push_back(boxAttributes(shape.movingBox.empty() ? geometry.box : shape.movingBox, geometry.lattice));
  writer_.open(element);
  writeChildren(node);
  writeAppearanceOf(shape);
  if (!geometry.isShared)
    writeGeometryOf(node);
  writer_.close(element);
}

} // namespace imgeo
