#include "documents/documents.h"

#include "documents/animation_element.h"
#include "documents/appearance_reader.h"
#include "documents/content_element.h"
#include "documents/field_reader.h"
#include "documents/geometry_reader.h"
#include "documents/node_fields_reader.h"
#include "documents/shape_geometry_reader.h"
#include "documents/skin_element.h"
#include "markup/find_x3d.h"
#include "markup/x3d_element.h"
#include "scene/mf_string.h"
#include "scene/nesting.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

namespace imgeo {

namespace {

constexpr std::size_t maxDocumentBytes = 64u << 20; // some hundred thousand patches
constexpr std::size_t maxDepth = 256;               // of nested elements

constexpr std::array nodeNames{
    "Shape",      "Group",     "Transform",  "Viewpoint",  "OrthoViewpoint", "DirectionalLight",
    "PointLight", "SpotLight", "TimeSensor", "HAnimJoint", "HAnimHumanoid"};

constexpr const char* routeName = "ROUTE";

/// Whether a url is that of a document that `convert` has written: "0123456789abcdef.x3d".
bool isNamedByContent(std::string_view url) {
  return url.size() == 20 && url.ends_with(".x3d") && url.find_first_not_of("0123456789abcdef") == 16;
}

bool hasElements(const pugi::xml_node& node) {
  return std::ranges::any_of(node.children(), [](const auto& child) { return child.type() == pugi::node_element; });
}

bool hasColors(const GeometryDescription& geometry) {
  return std::ranges::any_of(geometry.patches, [](const PatchDescription& patch) {
    return patch.vertexAttributes[VertexRole::color].has_value();
  });
}

class SceneReader {
public:
  SceneReader(const DocumentText& source, const ReadNodeGeometry& readNode)
      : source_(source), appearances_(source, document_.graph, warnings_),
        geometries_(source, document_.geometries, warnings_, readNode) {}

  SceneDocument read(const pugi::xml_node& x3d) {
    bool found = false;
    for (const pugi::xml_node& child : x3d.children())
      if (equalIgnoringCase(child.name(), "Scene")) {
        if (found)
          fail(child, ErrorKind::malformed, "there are two Scenes");
        found = true;
        document_.graph.roots = readChildren(child, 1);
        readRoutes(child);
      }
    if (!found)
      fail(x3d, ErrorKind::malformed, "there is no Scene in the X3D element");
    checkNestingLimit(document_.graph, source_.name);
    addRoutes();
    return std::move(document_);
  }

private:
  [[noreturn]] void fail(const pugi::xml_node& node, ErrorKind kind, const std::string& message) const {
    imgeo::fail(source_, node, kind, message);
  }

  std::vector<std::size_t> readChildren(const pugi::xml_node& parent, std::size_t depth) {
    if (depth > maxDepth)
      fail(parent, ErrorKind::limit, "elements are nested too deeply");
    std::vector<std::size_t> children;
    for (const pugi::xml_node& node : parent.children())
      if (const std::optional<std::size_t> child = readChild(FieldReader(source_, node, &warnings_), depth))
        children.push_back(*child);
    return children;
  }

  /// Reads the node of an element, if it is a node of the scene graph.
  std::optional<std::size_t> readChild(const FieldReader& fields, std::size_t depth) {
    addImages(fields);
    const auto is = [&](const char* name) { return equalIgnoringCase(fields.node().name(), name); };
    if (is("WorldInfo")) {
      document_.graph.title = fields.text("title");
      document_.graph.info = fields.strings("info");
    } else if (is("NavigationInfo")) {
      document_.graph.headlight = fields.boolean("headlight", true);
      if (const std::vector<std::string> types = fields.strings("type"); !types.empty()) {
        const std::size_t node = add(fields, GenericNode{"NavigationInfo", "", {}});
        document_.graph.nodes[node].fields = {{"type", quoteStrings(types)}};
        return node;
      }
    } else if (is("Background")) {
      readBackground(fields);
    } else if (is("Inline")) {
      return readInline(fields);
    } else if (isGeometryNode(fields.node().name())) {
      geometries_.readShared(fields);
    } else if (is(routeName)) {
      return {};
    } else if (std::ranges::any_of(nodeNames, is) || interpolatorKindOf(fields.node().name())) {
      const std::string use = fields.text("USE");
      return use.empty() ? readNodeElement(fields, depth) : usedNode(fields, use);
    } else if (const std::string use = fields.text("USE"); !use.empty()) {
      if (const auto found = defined_.find(use); found != defined_.end())
        return found->second;
    } else if (hasElements(fields.node())) {
      if (is("Switch") || is("LOD"))
        ++document_.choiceElements[fields.node().name()];
      return add(fields, Group{}, readChildren(fields.node(), depth + 1)); // an unknown element may contain shapes
    } else if (fields.node().type() == pugi::node_element) {
      ++document_.otherElements[fields.node().name()];
    }
    return {};
  }

  /// Reads an Inline whose document `convert` has written beside this one. The caller reads that document.
  std::optional<std::size_t> readInline(const FieldReader& fields) {
    if (const std::string use = fields.text("USE"); !use.empty())
      return defined_.contains(use) ? std::optional(defined_.at(use)) : std::nullopt;
    const std::vector<std::string> urls = fields.strings("url");
    if (urls.size() != 1 || !isNamedByContent(urls[0]))
      return {};
    std::vector<InlinedDocument>& inlined = document_.graph.inlined;
    const auto found = std::ranges::find(inlined, urls[0], &InlinedDocument::url);
    const std::size_t index = static_cast<std::size_t>(found - inlined.begin());
    if (found == inlined.end())
      inlined.push_back({urls[0], {}});
    const std::size_t node = add(fields, GenericNode{"Inline", "", {}, index});
    document_.graph.nodes[node].fields = {{"url", urls[0]}};
    return node;
  }

  /// The node that an element USEs. Returns nothing for a Shape that was left out; throws Error{malformed} for an
  /// unknown name.
  std::optional<std::size_t> usedNode(const FieldReader& fields, const std::string& use) const {
    if (leftOut_.contains(use))
      return {};
    const auto found = defined_.find(use);
    if (found == defined_.end())
      fields.fail(ErrorKind::malformed, std::string("USE names no ") + fields.node().name() + " that stands before");
    return found->second;
  }

  std::optional<std::size_t> readNodeElement(const FieldReader& fields, std::size_t depth) {
    const auto is = [&](const char* name) { return equalIgnoringCase(fields.node().name(), name); };
    if (is("Shape"))
      return readShape(fields);
    if (is("Group") || is("Transform") || is("HAnimJoint"))
      return readGrouping(fields, depth);
    if (is("HAnimHumanoid"))
      return readHumanoid(fields, depth);
    std::optional<NodeContent> content = readContent(fields);
    return content ? std::optional(add(fields, *std::move(content))) : std::nullopt;
  }

  std::size_t add(const FieldReader& fields, NodeContent content, std::vector<std::size_t> children = {}) {
    Node node{fields.text("DEF"), std::move(content), std::move(children), extrasOf(fields.node())};
    const std::size_t index = addNode(document_.graph, std::move(node));
    if (const std::string& name = document_.graph.nodes[index].name; !name.empty())
      defined_[name] = index;
    return index;
  }

  std::string extrasOf(const pugi::xml_node& node) {
    for (const pugi::xml_node& child : node.children()) {
      const FieldReader fields(source_, child, &warnings_);
      if (!equalIgnoringCase(child.name(), "MetadataString") || fields.text("name") != "extras")
        continue;
      const std::vector<std::string> values = fields.strings("value");
      return values.empty() ? "" : values[0];
    }
    return "";
  }

  /// A humanoid whose joints are elsewhere in the document. One of another program is a Group.
  std::size_t readHumanoid(const FieldReader& fields, std::size_t depth) {
    if (!fields.has(inverseBindingsField))
      return add(fields, Group{}, readChildren(fields.node(), depth + 1));
    Humanoid humanoid;
    std::vector<std::size_t> shapes;
    for (const pugi::xml_node& child : fields.node().children()) {
      const FieldReader childFields(source_, child, &warnings_);
      if (!isJointElement(childFields)) {
        if (const std::optional<std::size_t> shape = readChild(childFields, depth + 1))
          shapes.push_back(*shape);
        continue;
      }
      const std::optional<std::size_t> joint = usedNode(childFields, childFields.text("USE"));
      if (!joint || !std::holds_alternative<Transform>(document_.graph.nodes[*joint].content))
        childFields.fail(ErrorKind::malformed, "USE names no HAnimJoint that stands before");
      humanoid.joints.push_back(*joint);
    }
    humanoid.inverseBindings = readInverseBindings(fields, humanoid.joints.size());
    return add(fields, std::move(humanoid), std::move(shapes));
  }

  std::size_t readGrouping(const FieldReader& fields, std::size_t depth) {
    const bool isJoint = equalIgnoringCase(fields.node().name(), "HAnimJoint");
    const bool isTransform = isJoint || equalIgnoringCase(fields.node().name(), "Transform");
    const std::size_t geometriesBefore = document_.geometries.size();
    std::vector<std::size_t> children = readChildren(fields.node(), depth + 1);
    if (isTransform) {
      Transform transform = readNode<Transform>(fields);
      transform.isJoint = isJoint;
      return add(fields, transform, std::move(children));
    }
    if (joinPatches(fields, children, geometriesBefore))
      return add(fields, document_.graph.nodes[children[0]].content);
    return add(fields, Group{}, std::move(children));
  }

  /// Joins Shapes that x3dom_writer.h has written for the patches of one Shape: the children of a Group with a box, if
  /// all are Shapes of one appearance whose geometries differ only in their patches. Appends the patches to the
  /// geometry of the first Shape. Returns false if the children are not such Shapes.
  bool joinPatches(const FieldReader& fields, const std::vector<std::size_t>& children, std::size_t first) {
    const Box3d box = fields.box();
    if (box.empty() || children.empty() || document_.geometries.size() - first != children.size())
      return false;
    const auto shapeAt = [&](std::size_t i) { return std::get_if<Shape>(&document_.graph.nodes[children[i]].content); };
    for (std::size_t i = 0; i < children.size(); ++i) {
      const Shape* shape = shapeAt(i);
      if (!shape || !shape->appearance || shape->appearance != shapeAt(0)->appearance || shape->mesh != first + i ||
          !document_.graph.nodes[children[i]].name.empty() || !geometries_.isPatchLike(first + i, first))
        return false;
    }
    geometries_.joinPatches(first, box);
    return true;
  }

  /// Reads the routes of a scene, which may be within any node of it.
  void readRoutes(const pugi::xml_node& scene) {
    scene.find_node([&](const pugi::xml_node& node) {
      if (equalIgnoringCase(node.name(), routeName)) {
        const FieldReader fields(source_, node, &warnings_);
        ++document_.otherElements[routeName];
        routes_.push_back(
            {fields.text("fromNode"), fields.text("fromField"), fields.text("toNode"), fields.text("toField")});
      }
      return false;
    });
  }

  /// Adds the routes between nodes that the scene holds.
  void addRoutes() {
    for (const auto& [fromNode, fromField, toNode, toField] : routes_)
      if (const auto from = defined_.find(fromNode), to = defined_.find(toNode);
          from != defined_.end() && to != defined_.end())
        document_.graph.routes.push_back({from->second, fromField, to->second, toField});
  }

  /// Adds the images that fields of an element name, such as the pictures of a Background; a file for each field
  /// counts.
  void addImages(const FieldReader& fields) {
    for (const std::string_view field : imageFieldsOf(fields.node().name()))
      if (const std::vector<std::string> urls = fields.strings(field.data()); !urls.empty())
        document_.graph.images.push_back({urls[0], {}, fields.text("preview"), {urls.begin() + 1, urls.end()}});
  }

  void readBackground(const FieldReader& fields) {
    const std::vector<double> colors = fields.reals("skyColor");
    if (colors.size() >= 3)
      document_.graph.background = Background{Vec3f(Vec3d{colors[0], colors[1], colors[2]})};
  }

  /// Reads a displacer of a Shape.
  std::optional<std::size_t> readDisplacer(const FieldReader& fields) {
    const std::string use = fields.text("USE");
    return use.empty() ? add(fields, readNode<Displacer>(fields)) : usedNode(fields, use);
  }

  /// Reads a Shape. Returns nothing if its geometry cannot be read from where it is, or is missing.
  std::optional<std::size_t> readShape(const FieldReader& fields) {
    std::optional<Shape> shape;
    std::optional<std::size_t> appearance;
    std::vector<std::size_t> children; // displacers and interpolators of frames
    std::size_t geometryCount = 0;
    for (const pugi::xml_node& child : fields.node().children()) {
      if (child.type() != pugi::node_element)
        continue;
      if (equalIgnoringCase(child.name(), "HAnimDisplacer")) {
        if (const auto displacer = readDisplacer(FieldReader(source_, child, &warnings_)))
          children.push_back(*displacer);
        continue;
      }
      if (equalIgnoringCase(child.name(), "Appearance")) {
        appearance = appearances_.read(child);
      } else if (isGeometryNode(child.name())) {
        const FieldReader geometry(source_, child);
        if (geometryCount++ == 0 && geometries_.isInFiles(geometry)) {
          shape = geometries_.read(fields, geometry);
          std::ranges::copy(readFramesOf(child), std::back_inserter(children));
        }
      } else if (std::string_view(child.name()).starts_with("Metadata") || equalIgnoringCase(child.name(), routeName)) {
        continue;
      } else if (const auto read = geometries_.readInDocument(FieldReader(source_, child))) {
        if (geometryCount++ == 0)
          shape = read->shape;
      } else if (const FieldReader other(source_, child, &warnings_); !other.has("USE")) {
        ++document_.otherElements[child.name()];
        ++document_.geometryElements[child.name()];
      } else if (const std::string use = other.text("USE"); !source_.defs.contains(use)) {
        other.warnOrFail(fmt::format("USE=\"{}\" names no DEF of this scene", use), "it is left out");
      }
    }
    if (geometryCount > 1)
      fields.warnOrFail(fmt::format("a Shape has one geometry; of {} the first is drawn", geometryCount),
                        "the others are left out");
    if (const std::string patch = fields.text("patch"); !shape && !patch.empty())
      shape = geometries_.sharedPatch(fields, patch);
    if (!shape) {
      leftOut_.insert(fields.text("DEF"));
      return {};
    }
    shape->appearance = geometries_.isUnlit(shape->mesh)
                            ? appearances_.unlit(appearance, hasColors(document_.geometries[shape->mesh]))
                            : appearance;
    return add(fields, *shape, std::move(children));
  }

  /// The interpolators and movies of a geometry that have the frames of its vertices.
  std::vector<std::size_t> readFramesOf(const pugi::xml_node& geometry) {
    std::vector<std::size_t> nodes;
    for (const pugi::xml_node& child : geometry.children())
      if (interpolatorKindOf(child.name()) == InterpolatorKind::coordinate) {
        const FieldReader fields(source_, child, &warnings_);
        if (Interpolator interpolator = readInterpolator(InterpolatorKind::coordinate, fields);
            !interpolator.url.empty())
          nodes.push_back(add(fields, std::move(interpolator)));
      } else if (std::optional<Interpolator> movie = readMovie(FieldReader(source_, child))) {
        nodes.push_back(add(FieldReader(source_, child, &warnings_), *std::move(movie)));
      }
    return nodes;
  }

  const DocumentText& source_;
  SceneDocument document_;
  DocumentWarnings warnings_{document_.warnings};
  AppearanceReader appearances_;
  ShapeGeometryReader geometries_;
  std::map<std::string, std::size_t> defined_; ///< nodes by their DEF
  std::set<std::string> leftOut_;              ///< DEFs of Shapes whose geometry was not read, or is missing
  struct RouteText {
    std::string fromNode, fromField, toNode, toField;
  };
  std::vector<RouteText> routes_;
};

} // namespace

SceneDocument readScene(std::string_view text, const std::string& name, const ReadNodeGeometry& readNode) {
  if (text.size() > maxDocumentBytes)
    throw Error(ErrorKind::limit, name, "the document is larger than 64 MiB");
  const X3dElement x3d = parseX3d(text, name);
  const ElementsByDef defs = elementsByDef(x3d.root());
  const DocumentText source{text, name, x3d.offsets, defs};
  SceneDocument document = SceneReader(source, readNode).read(x3d.root());
  document.warnings.insert(document.warnings.begin(), x3d.warnings.begin(), x3d.warnings.end());
  return document;
}

} // namespace imgeo
