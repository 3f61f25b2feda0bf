#include "import/x3d/scene_reader.h"

#include "base/first_readable.h"
#include "import/x3d/container_geometry.h"
#include "import/x3d/faults.h"
#include "import/x3d/inlines.h"
#include "import/x3d/moving_meshes.h"
#include "import/x3d/node_images.h"
#include "import/x3d/routes.h"
#include "import/x3d/shape_children.h"
#include "import/x3d/shape_reader.h"
#include "import/x3d/shared_patches.h"
#include "import/x3d/summary.h"
#include "import/x3d/transform_reader.h"
#include "scene/mf_string.h"
#include "scene/nesting.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace imgeo::x3d {

namespace {

/// Whether a field is expressed by the scene graph and not kept as text.
bool isNameField(std::string_view field) {
  return field == "DEF" || field == "USE";
}

std::vector<FieldText> fieldsOf(pugi::xml_node element, std::initializer_list<std::string_view> without = {}) {
  std::vector<FieldText> fields;
  for (const pugi::xml_attribute& attribute : element.attributes())
    if (const std::string_view name = attribute.name();
        !isNameField(name) && std::ranges::find(without, name) == without.end())
      fields.push_back({std::string(name), attribute.value()});
  return fields;
}

class SceneReader {
public:
  SceneReader(const Source& source, const References& references, const ImportOptions& options)
      : faults_(source, options.strict, imported_.warnings, summary_), source_(source), routes_(source, faults_),
        images_(references, imported_.scene.graph.images),
        shapes_(source, references, options, imported_, summary_, faults_, routes_),
        inlines_(references, options, imported_.scene, imported_.warnings) {}

  Imported read() {
    SceneGraph& graph = imported_.scene.graph;
    graph.isComplete = true;
    graph.head.fields = fieldsOf(source_.root());
    for (const pugi::xml_node& child : source_.root().parent().children())
      if (child.type() == pugi::node_comment) // usually a copyright notice
        addTo(graph.roots, child);
    for (const pugi::xml_node& child : source_.root().children())
      if (std::string_view(child.name()) == "head")
        for (const pugi::xml_node& element : child.children())
          addTo(graph.head.header, element);
      else if (std::string_view(child.name()) == "Scene")
        for (const pugi::xml_node& element : child.children())
          addTo(graph.roots, element);
      else if (child.type() == pugi::node_comment)
        addTo(graph.roots, child);
    addTitle();
    MovingMeshes movingMeshes(graph, shapes_.recorded(), defined_);
    graph.routes = routes_.read(defined_, [&](pugi::xml_node node) {
      if (movingMeshes.replaces(node))
        return true;
      // A USE may name a node inside an element that is left out.
      if (movingMeshes.has(node) || defined_.contains(node.attribute("DEF").value()))
        return false;
      for (; node && node != source_.root(); node = node.parent())
        if (isLeftOut(node.name()) || routes_.isMalformed(node))
          return true;
      return false;
    });
    movingMeshes.finish();
    shapes_.finish();
    summary_.addTo(imported_.warnings);
    return std::move(imported_);
  }

private:
  void addTo(std::vector<std::size_t>& list, pugi::xml_node element) {
    if (const std::optional<std::size_t> node = readElement(element))
      list.push_back(*node);
  }

  std::optional<std::size_t> readElement(pugi::xml_node element) {
    if (element.type() == pugi::node_comment)
      return addNode(imported_.scene.graph, {"", GenericNode{commentElement, element.value(), {}}, {}, ""});
    if (element.type() != pugi::node_element || isContainerGeometry(source_.resolved(element).name()))
      return {}; // a geometry of files is left out where it does not become a mesh
    if (std::string_view(element.name()) == "ROUTE") {
      if (routes_.isImported(element))
        return addNode(imported_.scene.graph, {"", GenericNode{"ROUTE", "", {}}, {}, "", fieldsOf(element)});
      routes_.note(element);
      return {};
    }
    if (const pugi::xml_attribute use = element.attribute("USE"))
      return resolveUse(element, use.value());
    if (isLeftOut(element.name())) {
      faults_.leaveOut(element);
      return {};
    }
    return readNode(element);
  }

  std::optional<std::size_t> resolveUse(pugi::xml_node element, const std::string& name) {
    if (const auto found = defined_.find(name); found != defined_.end())
      return found->second;
    const pugi::xml_node target = source_.resolved(element);
    if (target && (isLeftOut(target.name()) || routes_.isMalformed(target)))
      return {}; // a warning already names it
    const bool isEnclosing = reading_.contains(target.internal_object());
    if (target && !isEnclosing) // the DEF is inside a converted geometry, or later in the document
      return readNode(target);
    return faults_.attempt("Left out", [&]() -> std::optional<std::size_t> {
      source_.fail(
          element, ErrorKind::malformed,
          fmt::format("USE=\"{}\" names {}", name, isEnclosing ? "a node that contains it" : "no DEF of this scene"));
    });
  }

  std::optional<std::size_t> readInterpolator(InterpolatorKind kind, pugi::xml_node element) {
    std::optional<Interpolator> interpolator = routes_.interpolator(kind, element);
    if (!interpolator)
      return {};
    Node node;
    node.content = *std::move(interpolator);
    node.fields = fieldsOf(element);
    addChildren(element, node, {});
    summary_.noteKept(element.name());
    return addNode(imported_.scene.graph, std::move(node));
  }

  /// Reads an element with its children and notes its DEF. Empty for a malformed interpolator.
  std::optional<std::size_t> readNode(pugi::xml_node element) {
    if (reading_.size() >= maxNestedNodes)
      source_.fail(element, ErrorKind::limit, "nodes are nested too deeply");
    reading_.insert(element.internal_object());
    const std::optional<InterpolatorKind> kind = interpolatorKindOf(element.name());
    const std::optional<std::size_t> node = kind ? readInterpolator(*kind, element) : readNodeContent(element);
    reading_.erase(element.internal_object());
    if (const pugi::xml_attribute def = element.attribute("DEF"); node && def) {
      imported_.scene.graph.nodes[*node].name = def.value();
      defined_[def.value()] = *node;
    }
    return node;
  }

  std::size_t readNodeContent(pugi::xml_node element) {
    const std::string_view name = element.name();
    if (name == "Shape")
      if (const std::optional<std::size_t> shape = readShape(element))
        return *shape;
    if (name == "ExternalShape")
      return readExternalShape(element);
    if (const std::vector<pugi::xml_node> patches = geometriesOfPatches(source_, element); !patches.empty())
      if (const std::optional<std::size_t> shape = readShapeOfPatches(element, patches))
        return *shape;
    Node node;
    if (name == "Transform") {
      node.fields = fieldsOf(element);
      const Transform transform = readTransform(source_, element, faults_, node.fields);
      summary_.noteScale(transform.scale);
      node.content = transform;
    } else if (const Skin* skin = source_.skinOf(element)) {
      readHumanoid(*skin, node);
    } else if (name == "Group") {
      node.content = Group{};
      node.fields = fieldsOf(element);
    } else if (name == "TimeSensor") {
      node.fields = fieldsOf(element);
      node.content = routes_.timeSensor(element, node.fields);
    } else {
      node.content = genericNodeOf(element);
      // `preview` and `patch` name parts of the site that is converted.
      node.fields = !imageFieldsOf(name).empty() ? fieldsOf(element, {"preview"})
                    : name == "Shape"            ? fieldsOf(element, {"patch"})
                                                 : fieldsOf(element);
      summary_.remoteImages += keepRemoteImageUrls(std::get<GenericNode>(node.content), node.fields);
    }
    if (name == "Inline")
      addInlined(element, node);
    else
      addChildren(element, node, {});
    summary_.noteKept(name);
    return addNode(imported_.scene.graph, std::move(node));
  }

  /// A joint that is not in the skeleton becomes a child of the Humanoid.
  void readHumanoid(const Skin& skin, Node& node) {
    SceneGraph& graph = imported_.scene.graph;
    Humanoid humanoid{{}, skin.inverseBindings};
    for (const std::string& joint : skin.joints) {
      const auto found = defined_.find(joint);
      if (found == defined_.end() || !std::holds_alternative<Transform>(graph.nodes[found->second].content)) {
        defined_[joint] = addNode(graph, {joint, Transform{}, {}, ""});
        node.children.push_back(defined_[joint]);
      }
      std::get<Transform>(graph.nodes[defined_[joint]].content).isJoint = true;
      humanoid.joints.push_back(defined_[joint]);
    }
    node.content = std::move(humanoid);
  }

  void addChildren(pugi::xml_node element, Node& node, pugi::xml_node without) {
    for (const pugi::xml_node& child : element.children())
      if (child != without && !wouldAppear(child, element) && !isFurtherGeometry(child, element))
        addTo(node.children, child);
  }

  /// Whether a node that pages draw is a child of a node without effect, such as a sensor, which refers to it: pages
  /// would draw it there too.
  static bool wouldAppear(pugi::xml_node child, pugi::xml_node parent) {
    const NodeRow *row = nodeRow(child.name()), *parentRow = nodeRow(parent.name());
    const bool isOfScene = row && row->containerField == "children" && row->treatment == NodeTreatment::drawn;
    return isOfScene && parentRow && parentRow->level > 0 && parentRow->treatment == NodeTreatment::kept;
  }

  GenericNode genericNodeOf(pugi::xml_node element) {
    GenericNode node{element.name(), element.text().get(), {}};
    const auto fields = imageFieldsOf(node.element);
    for (const std::string_view field : fields)
      if (const pugi::xml_attribute url = element.attribute(field.data())) {
        const std::optional<std::size_t> found =
            faults_.attempt("A texture is left as it is", [&] { return images_.read(parseStrings(url.value())); });
        if (found)
          node.images.push_back({std::string(field), *found});
      }
    if (fields.empty() && element.attribute("url") && node.element != "Inline")
      ++summary_.notCopied[node.element];
    return node;
  }

  /// The document of the first URL of an Inline that can be read; empty where a URL of another host precedes it.
  std::optional<Inlines::Document> inlined(pugi::xml_node element) {
    std::vector<Error> errors;
    for (const std::string& url : parseStrings(element.attribute("url").value())) {
      if (isRemote(url)) {
        ++summary_.remoteInlines;
        return {};
      }
      try {
        return inlines_.read(url);
      } catch (const Error& error) {
        if (error.kind() == ErrorKind::limit)
          throw;
        errors.push_back(error);
      }
    }
    if (errors.empty())
      return {};
    const Error error = joined(errors);
    if (error.location().empty())
      source_.fail(element, error.kind(), error.message());
    throw error;
  }

  /// Makes the nodes of an Inline's document its children.
  void addInlined(pugi::xml_node element, Node& node) {
    const std::optional<Inlines::Document> document =
        faults_.attempt("An Inline is left as it is", [&] { return inlined(element); });
    if (!document)
      return;
    std::get<GenericNode>(node.content).document = document->index;
    node.children = document->roots;
  }

  /// Reads a Shape whose geometry becomes a mesh; returns empty for any other.
  std::optional<std::size_t> readShape(pugi::xml_node element) {
    if (hasSharedPatch(source_, element)) {
      const std::optional<Shape> shape = shapes_.shapeOfSharedPatch(element);
      return shape ? std::optional(addShapeNodes(element, {*shape}, {}, {})) : std::nullopt;
    }
    requireOneGeometry(source_, element, faults_);
    for (const pugi::xml_node& child : element.children()) {
      if (child.type() != pugi::node_element || isFurtherGeometry(child, element))
        continue;
      const pugi::xml_node geometry = source_.resolved(child);
      const pugi::xml_node generator = cameraGeneratorOf(source_, element, geometry);
      const std::vector<Shape> shapes = shapes_.shapesOf(geometry, !generator.empty());
      if (!shapes.empty())
        return addShapeNodes(element, shapes, child, generator);
    }
    return {};
  }

  /// Adds Shapes, in a Group unless it is one, each with the fields of `element` and its children other than
  /// `geometry`. `generator`: see cameraGeneratorOf.
  std::size_t addShapeNodes(pugi::xml_node element, const std::vector<Shape>& shapes, pugi::xml_node geometry,
                            pugi::xml_node generator) {
    Node node;
    node.fields = fieldsOf(element, {"bboxCenter", "bboxSize", "patch"});
    addChildren(element, node, geometry);
    if (generator)
      addTo(node.children, generator);
    return addCopies(std::move(node), shapes);
  }

  /// Adds a node for each shape, in a Group unless it is one.
  std::size_t addCopies(Node node, const std::vector<Shape>& shapes) {
    SceneGraph& graph = imported_.scene.graph;
    std::vector<std::size_t> copies;
    for (const Shape& shape : shapes) {
      node.content = shape;
      copies.push_back(addNode(graph, node));
    }
    return copies.size() == 1 ? copies[0] : addNode(graph, {"", Group{}, std::move(copies), ""});
  }

  /// An ExternalShape as the Shapes of its file; an empty Group where it cannot be read.
  std::size_t readExternalShape(pugi::xml_node element) {
    Node node;
    node.fields = fieldsOf(element, {"bboxCenter", "bboxSize", "url"});
    return addCopies(std::move(node), shapes_.shapesOfExternal(element));
  }

  /// Reads a Group of one Shape for each patch as one Shape. Empty where that fails: then each is a Shape of its own.
  std::optional<std::size_t> readShapeOfPatches(pugi::xml_node group, const std::vector<pugi::xml_node>& geometries) {
    const std::optional<Shape> shape = shapes_.shapeOfPatches(geometries);
    if (!shape)
      return {};
    Node node;
    node.content = *shape;
    node.fields = fieldsOf(group, {"bboxCenter", "bboxSize"});
    addTo(node.children, geometries[0].parent().child("Appearance"));
    return addNode(imported_.scene.graph, std::move(node));
  }

  void addTitle() {
    SceneGraph& graph = imported_.scene.graph;
    for (const std::size_t index : nodesOfDocument(graph, graph.roots))
      if (const GenericNode* node = std::get_if<GenericNode>(&graph.nodes[index].content))
        if (node->element == "WorldInfo" && graph.title.empty())
          for (const FieldText& field : graph.nodes[index].fields)
            if (field.name == "title")
              graph.title = field.value;
  }

  Imported imported_;
  Summary summary_;
  Faults faults_;
  const Source& source_;
  Routes routes_;
  NodeImages images_;
  ShapeReader shapes_;
  Inlines inlines_;
  std::map<std::string, std::size_t> defined_; ///< nodes by DEF name
  std::set<pugi::xml_node_struct*> reading_;   ///< elements whose reading has begun but not ended
};

} // namespace

Imported readSceneGraph(const Source& source, const References& references, const ImportOptions& options) {
  return SceneReader(source, references, options).read();
}

} // namespace imgeo::x3d
