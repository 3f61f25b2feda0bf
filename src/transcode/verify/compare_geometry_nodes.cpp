#include "transcode/verify/compare_geometry_nodes.h"

#include "base/file.h"
#include "documents/geometry_reader.h"
#include "import/x3d/node_table.h"
#include "markup/find_x3d.h"
#include "markup/x3d_element.h"
#include "scene/mf_string.h"
#include "transcode/site/site_files.h"
#include "transcode/verify/geometry_fields.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>

namespace imgeo {

namespace {

constexpr std::size_t shownDifferences = 20; ///< findings of elements; others are counted

/// X3D's name of a geometry node, whose letters may be in another case; of a node with which X3DOM draws geometry too.
/// Empty for other names.
std::string_view geometryNameOf(std::string_view element) {
  constexpr std::array nodesOfX3dom{std::string_view("BVHRefiner"), std::string_view("ExternalGeometry"),
                                    std::string_view("ExternalShape"), std::string_view("MultiPart"),
                                    std::string_view("PopGeometry")};
  const auto is = [&](std::string_view name) { return equalIgnoringCase(name, element); };
  if (const auto found = std::ranges::find_if(nodesOfX3dom, is); found != nodesOfX3dom.end())
    return *found;
  for (const x3d::NodeRow& row : x3d::nodeTable())
    if (row.containerField == "geometry" && is(row.name))
      return row.name;
  return element.ends_with("Geometry") || element.ends_with("geometry") ? element : std::string_view();
}

/// A document of the site, and what the comparison of its elements needs.
struct OpenedDocument : ComparedDocument {
  std::string name; ///< relative to the site
  std::string_view text;
  X3dElement x3d;
};

/// A geometry element of a document.
struct GeometryElement {
  const OpenedDocument* document;
  pugi::xml_node element;
};

template <typename Item> using ByKind = std::map<std::string, std::vector<Item>, std::less<>>;

/// Finds the geometry elements of a document and of those that it inlines, in the order in which nodesInOrder() visits
/// their nodes.
class ElementFinder {
public:
  explicit ElementFinder(const SiteDocument& site) : site_(site) {}

  ByKind<GeometryElement> find(const std::string& name, std::string_view text) {
    found_.clear();
    visit(open(name, text));
    return std::move(found_);
  }

private:
  /// The name of a geometry element whose geometry is not in files.
  std::string_view nameOf(pugi::xml_node element) {
    const auto [found, isNew] = names_.try_emplace(element.name());
    if (isNew && !isGeometryNode(element.name()))
      found->second = geometryNameOf(found->first);
    return found->second;
  }

  const OpenedDocument& open(const std::string& name, std::string_view text) {
    std::unique_ptr<OpenedDocument>& opened = opened_[name];
    if (opened)
      return *opened;
    opened = std::make_unique<OpenedDocument>();
    opened->isPage = isHtml(text, name);
    opened->name = name;
    opened->text = text;
    opened->x3d = parseX3d(text, (site_.root / name).string());
    opened->defs = elementsByDef(opened->x3d.root());
    return *opened;
  }

  void visit(const OpenedDocument& document) {
    struct Walker : pugi::xml_tree_walker {
      Walker(ElementFinder& elementFinder, const OpenedDocument& openedDocument)
          : finder(elementFinder), document(openedDocument) {}
      bool for_each(pugi::xml_node& node) override {
        if (node.type() != pugi::node_element || attributeOf(node, "USE"))
          return true;
        if (const std::string_view name = finder.nameOf(node); !name.empty())
          finder.found_[std::string(name)].push_back({&document, node});
        if (equalIgnoringCase(node.name(), "Inline"))
          finder.visitInlined(node, inlined);
        return true;
      }
      ElementFinder& finder;
      const OpenedDocument& document;
      std::set<std::string> inlined; ///< a document's nodes are visited once, whichever of its Inlines refer to them
    } walker(*this, document);
    for (pugi::xml_node scene : document.x3d.root().children())
      if (equalIgnoringCase(scene.name(), "Scene"))
        scene.traverse(walker);
  }

  /// The recursion ends, since openDocument() has counted all documents that inline one another.
  void visitInlined(pugi::xml_node element, std::set<std::string>& visited) {
    const std::vector<std::string> urls = parseStrings(attributeOf(element, "url").value());
    for (const InlinedText& inlined : site_.inlined)
      if (urls == std::vector{inlined.url} && visited.insert(inlined.url).second)
        visit(open(inlined.url, inlined.text));
  }

  const SiteDocument& site_;
  std::map<std::string, std::unique_ptr<OpenedDocument>> opened_; ///< by name
  std::map<std::string, std::string_view> names_;                 ///< of geometry, by that of an element
  ByKind<GeometryElement> found_;
};

ByKind<std::size_t> nodesOf(const SceneGraph& graph) {
  ByKind<std::size_t> nodes;
  for (const std::size_t node : nodesInOrder(graph))
    if (const auto* generic = std::get_if<GenericNode>(&graph.nodes[node].content))
      if (const std::string_view name = geometryNameOf(generic->element); !name.empty())
        nodes[std::string(name)].push_back(node);
  return nodes;
}

/// The elements from the Scene to this one, each with its DEF, or with its number among its siblings of the same name.
std::string pathOf(pugi::xml_node element) {
  std::string path;
  for (; element.parent() && element.parent().type() == pugi::node_element; element = element.parent()) {
    std::size_t number = 1, count = 0;
    bool isBefore = true;
    std::string step = element.name();
    const std::string def = attributeOf(element, "DEF").value();
    for (const pugi::xml_node& sibling : element.parent().children(element.name())) {
      isBefore = isBefore && sibling != element;
      number += isBefore;
      ++count;
    }
    if (!def.empty())
      step += " \"" + def + "\"";
    else if (count > 1)
      step += "[" + std::to_string(number) + "]";
    path.insert(0, path.empty() ? step : step.append("/"));
  }
  return path;
}

/// Compares elements of equal numbers; counts differences beyond those that are shown.
class DifferenceReport {
public:
  DifferenceReport(const SceneGraph& input, Findings& findings) : input_(input), findings_(findings) {}

  void compare(const GeometryElement& site, std::size_t node) {
    auto& comparer = comparers_[site.document];
    if (!comparer)
      comparer = std::make_unique<GeometryFieldComparer>(*site.document, input_);
    // An inlined document is that of a page and of its scene.x3d, and its elements may stand for several nodes.
    const auto difference = comparer->differenceOf(site.element, node);
    if (!difference || !different_.insert(site.element.internal_object()).second)
      return;
    if (different_.size() <= shownDifferences)
      findings_.add("{}: {} {}.",
                    locationOf(site.document->text, site.document->name, site.document->x3d.offsets.of(site.element)),
                    pathOf(site.element), *difference);
  }

  void addRest() {
    if (different_.size() > shownDifferences)
      findings_.add("{} more geometry nodes of documents differ.", different_.size() - shownDifferences);
  }

private:
  const SceneGraph& input_;
  Findings& findings_;
  std::map<const OpenedDocument*, std::unique_ptr<GeometryFieldComparer>> comparers_;
  std::set<pugi::xml_node_struct*> different_;
};

} // namespace

void compareGeometryNodes(const SiteDocument& site, bool hasSceneFile, const SceneGraph& input, Findings& findings) {
  const ByKind<std::size_t> inInput = nodesOf(input);
  ElementFinder finder(site);
  DifferenceReport report(input, findings);
  const auto compare = [&](const std::string& name, std::string_view text, const std::string& subject) {
    ByKind<GeometryElement> elements = finder.find(name, text);
    for (const auto& [kind, nodes] : inInput)
      elements.try_emplace(kind);
    for (const auto& [kind, found] : elements) {
      const auto nodes = inInput.find(kind);
      const std::size_t expected = nodes == inInput.end() ? 0 : nodes->second.size();
      if (found.size() != expected)
        findings.add("{} has {} {} {}, the input {}.", subject, found.size(), kind,
                     found.size() == 1 ? "node" : "nodes", expected);
      for (std::size_t i = 0; i < expected && found.size() == expected; ++i)
        report.compare(found[i], nodes->second[i]);
    }
  };
  compare(site.name, site.text, "The site");
  std::string scene;
  if (hasSceneFile && site.name != sceneName) {
    scene = asText(readFile(site.root / sceneName));
    compare(std::string(sceneName), scene, std::string(sceneName));
  }
  report.addRest();
}

} // namespace imgeo
