#include "documents/documents.h"

#include "documents/scene_writer.h"
#include "documents/x3dom_writer.h"
#include "documents/xml_text.h"

#include <algorithm>
#include <set>

namespace imgeo {

namespace {

/// Maximum number of preload hints; more would compete with each other.
constexpr std::size_t maxPreloads = 16;

/// Collects the Shapes outside of LOD and Switch, whose children the runtime chooses among.
void addUnconditionalShapes(const SceneGraph& graph, std::size_t node, std::set<std::size_t>& seen,
                            std::vector<std::size_t>& shapes) {
  const GenericNode* generic = std::get_if<GenericNode>(&graph.nodes[node].content);
  if (!seen.insert(node).second || (generic && (generic->element == "LOD" || generic->element == "Switch")))
    return;
  if (std::holds_alternative<Shape>(graph.nodes[node].content))
    shapes.push_back(node);
  for (const std::size_t child : graph.nodes[node].children)
    addUnconditionalShapes(graph, child, seen, shapes);
}

/// The urls that the runtime requests first, in its order: base meshes; for geometries without one, the files of
/// compact patches or the most significant coordinate bytes of all patches; then indices. Patches of geometries with a
/// base mesh are left out, since they would compete with it for bandwidth. Of geometries with levels: the root and the
/// first page of the index.
std::vector<std::string> firstRequests(const SceneDocument& document) {
  std::vector<std::string> urls;
  const auto addUrl = [&](const std::string& url) {
    if (urls.size() < maxPreloads && std::ranges::find(urls, url) == urls.end())
      urls.push_back(url);
  };
  const auto add = [&](const Reference& reference) { addUrl(reference.url); };
  std::vector<std::size_t> shapes;
  std::set<std::size_t> seen;
  for (const std::size_t root : document.graph.roots)
    addUnconditionalShapes(document.graph, root, seen, shapes);
  const auto forEachGeometry = [&](auto visit) {
    for (const std::size_t node : shapes)
      visit(document.geometries.at(shapeOf(document.graph, node).mesh));
  };
  const auto forEachPatch = [&](auto visit) {
    forEachGeometry([&](const GeometryDescription& geometry) {
      for (const PatchDescription& patch : geometry.patches)
        if (!geometry.base && !geometry.levels)
          visit(patch);
    });
  };
  forEachGeometry([&](const GeometryDescription& geometry) {
    if (geometry.base)
      add(*geometry.base);
    if (geometry.levels && !geometry.base)
      addUrl(groupUrl(geometry.levels->url, 0));
    if (geometry.levels)
      addUrl(geometry.levels->url);
  });
  forEachPatch([&](const PatchDescription& patch) {
    if (patch.data)
      add(*patch.data);
    if (!patch.coord.empty())
      add(patch.coord[0]);
  });
  forEachPatch([&](const PatchDescription& patch) {
    if (patch.index)
      add(*patch.index);
  });
  return urls;
}

std::string link(const char* relation, const std::string& url, const std::string& attributes = "") {
  return std::string("    <link rel=\"") + relation + "\"" + attributes + " href=" + quoteAttribute(url) + ">\n";
}

/// Open Graph's properties (https://ogp.me) of the picture that previews of links show, and the icon.
std::string pictureLines(const PagePictures& pictures, const std::string& title) {
  const auto property = [](const char* name, const std::string& value) {
    return std::string("    <meta property=\"") + name + "\" content=" + quoteAttribute(value) + ">\n";
  };
  std::string lines;
  if (!pictures.iconUrl.empty())
    lines += link("icon", pictures.iconUrl, " type=\"image/png\"");
  if (!pictures.pictureUrl.empty())
    lines += property("og:title", title) + property("og:type", "website") + property("og:image", pictures.pictureUrl) +
             property("og:image:width", "1200") + property("og:image:height", "630") +
             "    <meta name=\"twitter:card\" content=\"summary_large_image\">\n";
  return lines;
}

/// The text of a page. `head` and `x3d` are whole lines.
std::string page(const SceneDocument& document, const std::string& head, const PagePictures& pictures,
                 const std::string& x3d) {
  const std::string title = document.graph.title.empty() ? "imgeo" : document.graph.title;
  return "<!doctype html>\n"
         "<html lang=\"en\">\n"
         "  <head>\n"
         "    <meta charset=\"utf-8\">\n"
         "    <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "    <title>" +
         escapeText(title) + "</title>\n" + head + pictureLines(pictures, title) +
         "  </head>\n"
         "  <body>\n"
         "    <noscript>This page shows a 3D model and needs JavaScript to draw it.</noscript>\n" +
         x3d +
         "  </body>\n"
         "</html>\n";
}

constexpr const char* xmlDeclaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

} // namespace

std::string writeX3d(const SceneDocument& document) {
  return xmlDeclaration + SceneWriter(document, 0, DocumentKind::file).write();
}

std::string writeInlinedX3d(const SceneDocument& document, std::size_t inlineNode) {
  return xmlDeclaration + SceneWriter(document, 0, DocumentKind::file, inlineNode).write();
}

std::string writeHtml(const SceneDocument& document, const PageOptions& options) {
  // Modules that are needed at once come first: with HTTP/1.1 the first request is sent on the page's own connection, a
  // round trip before all others.
  std::string head;
  for (const std::string& url : options.eagerModuleUrls)
    head += link("modulepreload", url);
  head += link("modulepreload", options.runtimeUrl) + link("stylesheet", options.stylesheetUrl);
  // A base mesh is displayed without these modules, which would compete with it for bandwidth.
  const auto hasBase = [](const GeometryDescription& geometry) { return geometry.base.has_value(); };
  if (std::ranges::none_of(document.geometries, hasBase)) {
    for (const std::string& url : options.deferredModuleUrls)
      head += link("modulepreload", url);
    const auto isCompact = [](const GeometryDescription& geometry) { return geometry.encoding == Encoding::compact; };
    if (!options.filesModuleUrl.empty() && !std::ranges::all_of(document.geometries, isCompact))
      head += link("modulepreload", options.filesModuleUrl);
  }
  const auto hasLevels = [](const GeometryDescription& geometry) { return geometry.levels.has_value(); };
  if (!options.cutModuleUrl.empty() && std::ranges::any_of(document.geometries, hasLevels))
    head += link("modulepreload", options.cutModuleUrl);
  for (const std::string& url : firstRequests(document))
    head += link("preload", url, " as=\"fetch\" crossorigin=\"anonymous\" fetchpriority=\"high\"");
  head += "    <script type=\"module\" src=" + quoteAttribute(options.runtimeUrl) + "></script>\n";
  return page(document, head, options.pictures, SceneWriter(document, 2, DocumentKind::page).write());
}

std::string writeX3domX3d(const SceneDocument& document) {
  return xmlDeclaration + x3domElement(document, 0, DocumentKind::file);
}

std::string writeInlinedX3domX3d(const SceneDocument& document, std::size_t inlineNode) {
  return xmlDeclaration + x3domElement(document, 0, DocumentKind::file, inlineNode);
}

std::string writeX3domHtml(const SceneDocument& document, const X3domFiles& x3dom, const std::string& stylesheetUrl,
                           const PagePictures& pictures) {
  const auto integrityAttributes = [](const std::string& sum) {
    return sum.empty() ? "" : " integrity=" + quoteAttribute(sum) + " crossorigin=\"anonymous\"";
  };
  const std::string head = link("stylesheet", x3dom.stylesheetUrl, integrityAttributes(x3dom.stylesheetIntegrity)) +
                           link("stylesheet", stylesheetUrl) + "    <script src=" + quoteAttribute(x3dom.scriptUrl) +
                           integrityAttributes(x3dom.scriptIntegrity) + "></script>\n";
  return page(document, head, pictures, x3domElement(document, 2, DocumentKind::page));
}

std::string_view pageStylesheet() {
  return R"css(html,
body {
  height: 100%;
  margin: 0;
  background: #edf0f2;
  color: #333;
  font: 1rem/1.5 system-ui, sans-serif;
}

x3d {
  display: block;
  border: 0;
  width: 100%;
  height: 100%;
  overflow: hidden;
}

/* Otherwise the browser lays out all elements of the scene while the runtime loads, which takes seconds. */
head:has(script[type="module"]) + body x3d > scene {
  display: none;
}

noscript {
  display: block;
  padding: 2rem;
  text-align: center;
}
)css";
}

} // namespace imgeo
