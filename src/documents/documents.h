#pragma once
// documents: a Scene and the names of written files -> HTML and X3D text, and back.

#include "containers/geometry_description.h"
#include "scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// A scene whose meshes have been written into containers.
struct SceneDocument {
  SceneGraph graph;                            ///< Shape::mesh indexes `geometries`
  std::vector<GeometryDescription> geometries; ///< one per mesh
  /// Of readScene: what counts as absent, since it is malformed; one sentence each.
  std::vector<std::string> warnings;
};

struct PageOptions {
  std::string runtimeUrl;                        ///< the ES module, relative
  std::string stylesheetUrl;                     ///< relative
  std::vector<std::string> eagerModuleUrls{};    ///< modules that it needs at once; relative
  std::vector<std::string> deferredModuleUrls{}; ///< those that it needs when it has shown what bases it can; relative
};

/// `scene.x3d`: the scene as XML, readable by a person.
std::string writeX3d(const SceneDocument& document);

/// The document that an Inline shows, whose node it is, as a file of its own beside
/// the others; of documents that this one inlines the urls are known.
std::string writeInlinedX3d(const SceneDocument& document, std::size_t inlineNode);

/// `index.html`: the same <X3D> element in an HTML page, with the runtime as
/// modules and preload hints for the first geometry files. Needs nothing beyond
/// `default-src 'self'`.
std::string writeHtml(const SceneDocument& document, const PageOptions& options);

/// Where a page finds X3DOM; the sums are "sha384-..." of the files (W3C
/// Subresource Integrity) or empty.
struct X3domFiles {
  std::string scriptUrl, scriptIntegrity;
  std::string stylesheetUrl, stylesheetIntegrity;
};

/// The same two documents for X3DOM (docs/formats/x3dom.md), of containers that
/// were encoded for it.
std::string writeX3domX3d(const SceneDocument& document);
std::string writeInlinedX3domX3d(const SceneDocument& document, std::size_t inlineNode);
std::string writeX3domHtml(const SceneDocument& document, const X3domFiles& x3dom, const std::string& stylesheetUrl);

/// The text of the page's stylesheet: the scene fills the window.
std::string_view pageStylesheet();

/// Moves what `more` holds behind what `document` has; returns its top nodes, which
/// stand nowhere yet.
std::vector<std::size_t> append(SceneDocument& document, SceneDocument&& more);

/// Reads the <X3D> element of either text back. Inlines whose file lies beside the
/// document have an InlinedDocument, and nothing in it: append() fills it. What is wrong in
/// a node that convert may have carried over (a viewpoint, a material) is a warning, as
/// in browsers. Safe for untrusted text. Throws Error{malformed, unsupported, limit}
/// naming `name` and the place.
SceneDocument readScene(std::string_view text, const std::string& name);

} // namespace imgeo
