#pragma once
// Writes and reads X3D documents, HTML pages and X3D files, which hold a scene graph and the descriptions of its
// geometry files.

#include "containers/geometry_description.h"
#include "scene/scene.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// Numbers of elements, by name.
using ElementsByName = std::map<std::string, std::size_t>;

/// A scene whose meshes have been written into containers.
struct SceneDocument {
  SceneGraph graph;                            ///< Shape::mesh indexes `geometries`
  std::vector<GeometryDescription> geometries; ///< by mesh
  /// From readScene: number of elements, by their name in the text, that are no node of the graph: the children of
  /// Shapes but appearances, metadata and the nodes of `geometries`, and elements without children elsewhere. USEs do
  /// not count. A ROUTE counts wherever it stands, and by this name, whatever the case of its letters.
  ElementsByName otherElements;
  ElementsByName geometryElements; ///< those of them that are the geometry of a Shape
  /// From readScene: number of Switches and LODs, all children of which are in the graph, by their name in the text.
  ElementsByName choiceElements;
  /// From readScene: one sentence for each malformed value that is treated as absent.
  std::vector<std::string> warnings;
};

/// Urls of pictures of a page, relative to it. Empty: the page has none.
struct PagePictures {
  std::string iconUrl;    ///< for tabs and bookmarks
  std::string pictureUrl; ///< for previews of links (Open Graph), 1200 x 630 pixels
};

/// Urls of a page, relative to it.
struct PageOptions {
  std::string runtimeUrl;                        ///< the runtime's ES module
  std::string stylesheetUrl;                     ///< the page's stylesheet
  std::vector<std::string> eagerModuleUrls{};    ///< modules that the runtime needs at once
  std::vector<std::string> deferredModuleUrls{}; ///< modules that the runtime needs after it has displayed base meshes
  std::string filesModuleUrl{};                  ///< a module likewise, only for geometry of SIG classic and BG
  std::string cutModuleUrl{}; ///< a module that pages need at once, only for meshes with levels of detail
  PagePictures pictures{};
};

/// `scene.x3d`: the scene as XML, laid out for readability.
std::string writeX3d(const SceneDocument& document);

/// The document of the Inline node `inlineNode` as an X3D file of its own, beside `scene.x3d`. Documents that it
/// inlines must have been written before, so that their urls are known.
std::string writeInlinedX3d(const SceneDocument& document, std::size_t inlineNode);

/// `index.html`: the same <X3D> element in an HTML page that loads the runtime's modules and has preload hints for the
/// first geometry files. Works under the content security policy `default-src 'self'`.
std::string writeHtml(const SceneDocument& document, const PageOptions& options);

/// Urls of X3DOM for a page. Integrity values are "sha384-..." (W3C Subresource Integrity) or empty.
struct X3domFiles {
  std::string scriptUrl, scriptIntegrity;
  std::string stylesheetUrl, stylesheetIntegrity;
};

/// The same documents for X3DOM (docs/formats/x3dom.md). The containers must have been encoded for X3DOM.
std::string writeX3domX3d(const SceneDocument& document);
std::string writeInlinedX3domX3d(const SceneDocument& document, std::size_t inlineNode);
std::string writeX3domHtml(const SceneDocument& document, const X3domFiles& x3dom, const std::string& stylesheetUrl,
                           const PagePictures& pictures = {});

/// The page's stylesheet, with which the scene fills the window.
std::string_view pageStylesheet();

/// Appends the content of `more` to `document`. Returns the roots of `more`, which have no parent yet.
std::vector<std::size_t> append(SceneDocument& document, SceneDocument&& more);

/// A geometry that a document has as numbers of its own.
struct NodeGeometry {
  std::optional<GeometryDescription> geometry; ///< with data: URLs; nothing: the node draws nothing
  bool solid = true;
};

/// Reads the geometry element that stands at byte `offset` of the text. Empty where it is none that can be read.
using ReadNodeGeometry =
    std::function<std::optional<NodeGeometry>(std::string_view text, const std::string& name, std::size_t offset)>;

/// Reads the <X3D> element of an X3D or HTML text. With `readNode`, Shapes whose geometry is in the document are nodes
/// of the scene too; without, they are left out. An Inline whose file was written beside the document gets an
/// InlinedDocument but no children: the caller reads that file and append()s it. A malformed value of a node that may
/// come from the source (a viewpoint, a material) is a warning, as in browsers. Safe for untrusted text. Throws
/// Error{malformed, unsupported, limit} with `name` and the line.
SceneDocument readScene(std::string_view text, const std::string& name, const ReadNodeGeometry& readNode = {});

} // namespace imgeo
