#include "import/x3d/x3d.h"

#include "import/references.h"
#include "import/warnings.h"
#include "import/x3d/container_geometry.h"
#include "import/x3d/geometry.h"
#include "import/x3d/geometry_text.h"
#include "import/x3d/inlines.h"
#include "import/x3d/node_conversions.h"
#include "import/x3d/node_images.h"
#include "import/x3d/page.h"
#include "import/x3d/prototypes.h"
#include "import/x3d/shared_appearances.h"
#include "import/x3d/shared_patches.h"
#include "import/x3d/summary.h"
#include "import/x3d/texture_coordinates.h"
#include "import/x3d/unread_fields.h"
#include "scene/mf_string.h"

#include <array>
#include <fmt/format.h>
#include <set>

namespace imgeo {

namespace {

using namespace x3d;

constexpr std::size_t maxNodeDepth = 250;

/// Pages parse this much geometry text in the time that a worker takes to start. Documents with more keep only geometry
/// as short as a box (docs/decisions/scenes.md).
constexpr std::size_t maxInlineTextBytes = 64 << 10, shortTextBytes = 256;

/// Documents with more geometry text than this in short pieces keep none: a shape takes fewer bytes as an index in a
/// file that it shares (docs/decisions/tiny-shapes.md).
constexpr std::size_t maxShortTextBytes = 512 << 10;

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
      : source_(source), references_(references), isStrict_(options.strict), inlineBytes_(options.inlineBytes),
        keptAttributes_(options.attributes), mappings_(options.attributes),
        images_(references, imported_.scene.graph.images), containers_(source, references),
        sharedPatches_(source, containers_, keptAttributes_, attributes_,
                       [this](Mesh mesh, bool isSolid) { return addShape(std::move(mesh), isSolid); }),
        inlines_(references, options, imported_.scene, imported_.warnings) {
    addTextureMappings();
    if (smallGeometryTextBytes(source_, inlineBytes_) > maxInlineTextBytes)
      inlineBytes_ = std::min(inlineBytes_, shortTextBytes);
    if (smallGeometryTextBytes(source_, inlineBytes_) > maxShortTextBytes)
      inlineBytes_ = 0;
  }

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
    imported_.attributes.assign(attributes_.begin(), attributes_.end());
    sharedPatches_.addTo(imported_.warnings);
    summary_.addTo(imported_.warnings);
    return std::move(imported_);
  }

private:
  void addTo(std::vector<std::size_t>& list, pugi::xml_node element) {
    if (const std::optional<std::size_t> node = readElement(element))
      list.push_back(*node);
  }

  /// Calls `read` and turns its Error into a warning that begins with `consequence`. If strict, and for
  /// Error{limit}, rethrows it.
  template <typename Read> auto attempt(const char* consequence, const Read& read) -> decltype(read()) {
    try {
      return read();
    } catch (const Error& error) {
      if (isStrict_ || error.kind() == ErrorKind::limit)
        throw;
      imported_.warnings.push_back(fmt::format("{}: {}.", consequence, error.what()));
      return {};
    }
  }

  std::optional<std::size_t> readElement(pugi::xml_node element) {
    if (element.type() == pugi::node_comment)
      return addNode(imported_.scene.graph, {"", GenericNode{commentElement, element.value(), {}}, {}, ""});
    if (element.type() != pugi::node_element || isRouteOfLeftOut(element) || isContainerGeometry(element.name()))
      return {}; // a geometry of files is left out where it does not become a mesh
    if (const pugi::xml_attribute use = element.attribute("USE"))
      return resolveUse(element, use.value());
    if (isLeftOut(element.name())) {
      leaveOut(element);
      return {};
    }
    return define(element, readNode(element));
  }

  void leaveOut(pugi::xml_node element) {
    if (isStrict_)
      source_.fail(element, ErrorKind::unsupported,
                   fmt::format("left out, since {}", reasonToLeaveOut(element.name())));
    summary_.noteLeftOut(element.name(), source_.locationOf(element));
  }

  /// Whether a ROUTE connects a node that is left out, alone or within another.
  bool isRouteOfLeftOut(pugi::xml_node element) const {
    if (std::string_view(element.name()) != "ROUTE")
      return false;
    return std::ranges::any_of(std::array{"fromNode", "toNode"}, [&](const char* end) {
      pugi::xml_node node = source_.defined(element.attribute(end).value());
      while (node && node != source_.root() && !isLeftOut(node.name()))
        node = node.parent();
      return node && node != source_.root();
    });
  }

  std::size_t define(pugi::xml_node element, std::size_t node) {
    if (const pugi::xml_attribute def = element.attribute("DEF")) {
      imported_.scene.graph.nodes[node].name = def.value();
      defined_[def.value()] = node;
    }
    return node;
  }

  std::optional<std::size_t> resolveUse(pugi::xml_node element, const std::string& name) {
    if (const auto found = defined_.find(name); found != defined_.end())
      return found->second;
    const pugi::xml_node target = source_.resolved(element);
    if (target && isLeftOut(target.name()))
      return {}; // the summary already names its DEF
    const bool isEnclosing = reading_.contains(target.internal_object());
    if (target && !isEnclosing) // the DEF is inside a converted geometry, or later in the document
      return define(target, readNode(target));
    return attempt("Left out", [&]() -> std::optional<std::size_t> {
      source_.fail(element, ErrorKind::malformed,
                   fmt::format("USE=\"{}\" names {}", name, isEnclosing ? "a node that contains it" : "no DEF"));
    });
  }

  std::size_t readNode(pugi::xml_node element) {
    if (reading_.size() >= maxNodeDepth)
      source_.fail(element, ErrorKind::limit, "nodes are nested too deeply");
    reading_.insert(element.internal_object());
    const std::size_t node = readNodeContent(element);
    reading_.erase(element.internal_object());
    return node;
  }

  std::size_t readNodeContent(pugi::xml_node element) {
    const std::string_view name = element.name();
    if (name == "Shape")
      if (const std::optional<std::size_t> shape = readShape(element))
        return *shape;
    if (const std::vector<pugi::xml_node> patches = geometriesOfPatches(source_, element); !patches.empty())
      if (const std::optional<std::size_t> shape = readShapeOfPatches(element, patches))
        return *shape;
    Node node;
    if (name == "Transform") {
      node.fields = fieldsOf(element);
      node.content = readTransform(element, node.fields);
    } else if (name == "Group") {
      node.content = Group{};
      node.fields = fieldsOf(element);
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

  void addChildren(pugi::xml_node element, Node& node, pugi::xml_node without) {
    for (const pugi::xml_node& child : element.children())
      if (child != without && !wouldAppear(child, element))
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
            attempt("A texture is left as it is", [&] { return images_.read(parseStrings(url.value())); });
        if (found)
          node.images.push_back({std::string(field), *found});
      }
    if (fields.empty() && element.attribute("url") && node.element != "Inline")
      ++summary_.notCopied[node.element];
    return node;
  }

  /// The document of the first URL of an Inline that can be read; empty where a URL of another host precedes it.
  std::optional<Inlines::Document> inlined(pugi::xml_node element) {
    const std::vector<std::string> urls = parseStrings(element.attribute("url").value());
    for (std::size_t i = 0; i < urls.size(); ++i) {
      if (isRemote(urls[i])) {
        ++summary_.remoteInlines;
        return {};
      }
      try {
        return inlines_.read(urls[i]);
      } catch (const Error& error) {
        if (error.kind() == ErrorKind::limit || (i + 1 == urls.size() && !error.location().empty()))
          throw;
        if (i + 1 == urls.size())
          source_.fail(element, error.kind(), error.message());
      }
    }
    return {};
  }

  /// Makes the nodes of an Inline's document its children.
  void addInlined(pugi::xml_node element, Node& node) {
    const std::optional<Inlines::Document> document =
        attempt("An Inline is left as it is", [&] { return inlined(element); });
    if (!document)
      return;
    std::get<GenericNode>(node.content).document = document->index;
    node.children = document->roots;
  }

  /// Reads a Transform. Malformed fields count as absent and are removed from `fields`.
  Transform readTransform(pugi::xml_node element, std::vector<FieldText>& fields) {
    const auto numbers = [&](const char* field, std::size_t count) {
      std::vector<double> values = attempt("A field is left out", [&] {
        std::vector<double> read = source_.reals(element, field);
        if (element.attribute(field) && read.size() < count)
          source_.fail(element, ErrorKind::malformed,
                       fmt::format("{} has {} numbers of {}", field, read.size(), count));
        return read;
      });
      if (values.empty())
        std::erase_if(fields, [&](const FieldText& of) { return of.name == field; });
      return values;
    };
    const auto vector = [&](const char* field, Vec3d fallback) {
      const std::vector<double> v = numbers(field, 3);
      return v.empty() ? fallback : Vec3d{v[0], v[1], v[2]};
    };
    const auto rotation = [&](const char* field) {
      const std::vector<double> v = numbers(field, 4);
      return v.empty() ? Rotation{} : Rotation{{v[0], v[1], v[2]}, v[3]};
    };
    Transform transform;
    transform.translation = vector("translation", {});
    transform.rotation = rotation("rotation");
    transform.scale = vector("scale", {1, 1, 1});
    summary_.noteScale(transform.scale);
    transform.scaleOrientation = rotation("scaleOrientation");
    transform.center = vector("center", {});
    return transform;
  }

  /// Reads a Shape whose geometry becomes a mesh; returns empty for any other.
  std::optional<std::size_t> readShape(pugi::xml_node element) {
    if (hasSharedPatch(source_, element)) {
      const std::optional<Shape> shape = sharedPatches_.shapeOf(element, isStrict_);
      return shape ? std::optional(addShapeNode(element, *shape, {}, {})) : std::nullopt;
    }
    for (const pugi::xml_node& child : element.children()) {
      if (child.type() != pugi::node_element)
        continue;
      const pugi::xml_node geometry = source_.resolved(child);
      const pugi::xml_node generator = hasCubeMap(element) ? cameraGeneratorOf(geometry) : pugi::xml_node();
      const std::optional<Shape> shape = convertedShape(geometry, !generator.empty());
      if (!shape)
        continue;
      return addShapeNode(element, *shape, child, generator);
    }
    return {};
  }

  /// Adds a Shape with the fields of `element` and its children other than `geometry`. `generator`: see
  /// cameraGeneratorOf.
  std::size_t addShapeNode(pugi::xml_node element, const Shape& shape, pugi::xml_node geometry,
                           pugi::xml_node generator) {
    Node node;
    node.content = shape;
    node.fields = fieldsOf(element, {"bboxCenter", "bboxSize", "patch"});
    addChildren(element, node, geometry);
    if (generator)
      addTo(node.children, generator);
    return addNode(imported_.scene.graph, std::move(node));
  }

  /// Whether the Appearance of a Shape has a cube map.
  bool hasCubeMap(pugi::xml_node shape) const {
    const auto isCubeMap = [](const pugi::xml_node& node) {
      return std::string_view(node.name()).ends_with("CubeMapTexture");
    };
    return std::ranges::any_of(shape.children("Appearance"), [&](const pugi::xml_node& child) {
      return !source_.resolved(child).find_node(isCubeMap).empty();
    });
  }

  /// The TextureCoordinateGenerator of a geometry whose mode depends on the camera: pages draw cube maps by it. It
  /// becomes a child of the Shape, since a written geometry has no such node.
  pugi::xml_node cameraGeneratorOf(pugi::xml_node geometry) const {
    for (const pugi::xml_node& node : texCoordNodes(source_, geometry))
      if (std::string_view(node.attribute("mode").value()).starts_with("CAMERASPACE"))
        return node;
    return {};
  }

  /// Whether a geometry stays in the document because it is short and pages draw it from there.
  bool staysInline(pugi::xml_node node) const {
    return isDrawnInPages(node.name()) && geometryTextBytesOf(source_, node) <= inlineBytes_;
  }

  /// Adds the `mapping` of every texture of the document: the values of materials' fields such as normalTextureMapping.
  void addTextureMappings() {
    struct Walker : pugi::xml_tree_walker {
      explicit Walker(std::set<std::string>& into) : names(into) {}
      bool for_each(pugi::xml_node& node) override {
        for (const pugi::xml_attribute& attribute : node.attributes())
          if (std::string_view(attribute.name()).ends_with("TextureMapping"))
            names.insert(attribute.value());
        return true;
      }
      std::set<std::string>& names;
    };
    Walker walker(mappings_.names);
    source_.root().traverse(walker);
  }

  /// A shape with the mesh of a geometry node, one mesh for all its USEs. Empty for geometry that stays in the
  /// document, which is read too, to report its errors. `isForCubeMap`: its generator is drawn as it is.
  std::optional<Shape> convertedShape(pugi::xml_node node, bool isForCubeMap) {
    const auto [found, isNew] = converted_.try_emplace(node.internal_object());
    if (!isNew || !node)
      return found->second;
    if (isContainerGeometry(node.name()))
      return found->second = shapeOfFiles(node);
    std::optional<Geometry> geometry =
        attempt("A geometry is left as it is", [&] { return readGeometry(source_, node, mappings_); });
    if (!geometry)
      return {};
    if (geometry->mesh.corners.empty()) {
      ++summary_.empty[node.name()];
      return {};
    }
    if (geometry->nurbsError)
      summary_.noteNurbs(*geometry->nurbsError);
    summary_.furtherTexCoords += geometry->furtherTexCoords > 0 ? 1 : 0;
    if (!geometry->approximatedTexCoords.empty() && !isForCubeMap)
      ++summary_.approximatedTexCoords[geometry->approximatedTexCoords];
    if (staysInline(node))
      return {};
    noteDataOf(node);
    summary_.fans += geometry->fans;
    return found->second = addShape(std::move(geometry->mesh), geometry->solid);
  }

  Shape addShape(Mesh mesh, bool isSolid) {
    std::vector<Mesh>& meshes = imported_.scene.meshes;
    meshes.push_back(std::move(mesh));
    return {meshes.size() - 1, {}, isSolid};
  }

  /// Reads a Group of one Shape for each patch as one Shape. Empty where that fails: then each is a Shape of its own.
  std::optional<std::size_t> readShapeOfPatches(pugi::xml_node group, const std::vector<pugi::xml_node>& geometries) {
    std::optional<Mesh> mesh;
    try {
      mesh = containers_.read(geometries, keptAttributes_, attributes_);
    } catch (const Error&) {
      return {}; // the Shape of the geometry that cannot be read has a warning
    }
    if (!mesh || mesh->corners.empty())
      return {};
    Node node;
    node.content = addShape(std::move(*mesh), source_.boolean(geometries[0], "solid", true));
    node.fields = fieldsOf(group, {"bboxCenter", "bboxSize"});
    addTo(node.children, geometries[0].parent().child("Appearance"));
    return addNode(imported_.scene.graph, std::move(node));
  }

  /// A shape with the mesh that a node's files hold. Empty where they cannot be read: pages could not either.
  std::optional<Shape> shapeOfFiles(pugi::xml_node node) {
    std::optional<Mesh> mesh;
    try {
      mesh = containers_.read(std::array{node}, keptAttributes_, attributes_);
    } catch (const Error& error) {
      if (isStrict_) // a missing file is a fault of the document, not of the disk
        throw Error(error.kind() == ErrorKind::io ? ErrorKind::malformed : error.kind(), error.location(),
                    error.message());
      imported_.warnings.push_back(
          fmt::format("{}: {} left out: {}.", source_.locationOf(node), node.name(), error.what()));
      return {};
    }
    if (mesh->corners.empty()) {
      ++summary_.empty[node.name()];
      return {};
    }
    return addShape(std::move(*mesh), source_.boolean(node, "solid", true));
  }

  /// Notes the children of a geometry node that its mesh does not hold.
  void noteDataOf(pugi::xml_node geometry) {
    for (const pugi::xml_node& child : geometry.children())
      if (child.type() == pugi::node_element && isLeftOut(child.name()))
        leaveOut(child);
      else
        summary_.noteKept(child.name());
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

  const Source& source_;
  const References& references_;
  bool isStrict_;
  std::size_t inlineBytes_;
  const AttributeChoice& keptAttributes_;
  AttributeChoice mappings_; ///< keptAttributes_ and the sets of texture coordinates that textures use
  Imported imported_;
  NodeImages images_;
  ContainerGeometries containers_;
  std::set<std::string> attributes_; ///< names of the vertex attributes of geometries of files
  SharedPatches sharedPatches_;
  Inlines inlines_;
  std::map<std::string, std::size_t> defined_;                       ///< nodes by DEF name
  std::set<pugi::xml_node_struct*> reading_;                         ///< elements whose reading has begun but not ended
  std::map<pugi::xml_node_struct*, std::optional<Shape>> converted_; ///< by geometry node
  Summary summary_;
};

} // namespace

Imported x3d::readElements(Elements elements, ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const References references(options, name);
  ExternPrototypes externals(references);
  const PrototypeReport prototypes = expandPrototypes(elements, name, externals);
  if (options.strict && !prototypes.failures.empty())
    throw Error(ErrorKind::unsupported, name, prototypes.failures[0]);
  std::vector<std::string> unread;
  warnOfUnreadFields(elements, unread);
  const NodeConversions conversions = convertNodes(elements);
  const std::size_t sharedAppearances = shareAppearances(elements);
  const std::string format = elements.format;
  std::vector<std::string> warnings = std::move(elements.warnings);
  const Source source(std::move(elements), asText(bytes), name);
  Imported imported = SceneReader(source, references, options).read();
  imported.format = format;
  imported.warnings.insert(imported.warnings.begin(), warnings.begin(), warnings.end());
  for (const std::string& failure : prototypes.failures)
    imported.warnings.push_back(failure + ".");
  if (prototypes.instances > 0)
    imported.warnings.push_back(fmt::format("{} of {} written out as the nodes that they stand for.",
                                            counted(prototypes.instances, "instance", "instances"),
                                            counted(prototypes.prototypes, "prototype is", "prototypes are")));
  if (sharedAppearances > 0)
    imported.warnings.push_back(fmt::format("{} of an equal one: the scene has more than {} shapes.",
                                            counted(sharedAppearances, "Appearance is a USE", "Appearances are USEs"),
                                            maxShapesWithOwnAppearance));
  std::ranges::move(unread, std::back_inserter(imported.warnings));
  warnOfElements(imported.warnings, "Left out of prototypes", prototypes.leftOut);
  warnOfElements(imported.warnings, "Written as other nodes", conversions.converted);
  warnOfElements(imported.warnings, "Left out of materials", conversions.leftOut);
  warnOfElements(imported.warnings, "Hidden, since the order of their LayerSet does not name them", conversions.hidden);
  warnOfElements(imported.warnings, "Left out of layers that are not active, since pages have one camera",
                 conversions.unbound);
  return imported;
}

bool isX3d(ByteSpan bytes) {
  const std::string_view beginning = asText(bytes).substr(0, 4096);
  return beginning.starts_with("<") && beginning.find("<X3D") != beginning.npos && !isPage(bytes);
}

Imported readX3d(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return readElements(parseXml(asText(bytes), name), bytes, name, options);
}

} // namespace imgeo
