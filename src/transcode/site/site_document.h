#pragma once
// A finished site -> its document and the files that this names. Safe for
// untrusted bytes; all throw Error.

#include "containers/container.h"
#include "documents/documents.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// A document that another inlines.
struct InlinedText {
  std::string url, text;
};

/// A document and the folder its urls are relative to.
struct SiteDocument {
  std::filesystem::path root;
  std::string name; ///< of the document inside `root`
  std::string text;
  SceneDocument scene;              ///< with that of the documents that it inlines
  std::vector<InlinedText> inlined; ///< those that are there
};

/// Opens a site's directory (its index.html, or else its scene.x3d) or a document, and
/// the documents beside it that it inlines, as far as they are there.
SiteDocument openDocument(const std::filesystem::path& site);

/// A file that a document names, and what it calls it.
struct NamedFile {
  std::string url;
  Role role = Role::coord;
};

/// Every geometry file of a scene once, in the order of first mention.
std::vector<NamedFile> geometryFilesOf(const SceneDocument& scene);

/// The urls of the images that textures show, each once, in the order of first
/// mention; those of other hosts are left out.
std::vector<std::string> textureFilesOf(const SceneDocument& scene);

/// The same of their previews.
std::vector<std::string> previewFilesOf(const SceneDocument& scene);

/// The urls of the runtime module and the stylesheet that a page names; those of
/// other hosts, X3DOM's and absent ones are left out.
std::vector<std::string> pageFilesOf(std::string_view html);

/// The same of a site, with the modules that its runtime brings by itself, as far as
/// they are there; none where the document is no page.
std::vector<std::string> pageFilesOf(const SiteDocument& document);

/// The file of a relative url; Error{unsupported} for a url that leaves the
/// document's folder.
std::filesystem::path fileOf(const SiteDocument& document, const std::string& url);

/// The same as the bytes of urls. `document` outlives it.
FetchFile fetchFrom(const SiteDocument& document);

/// Whether a relative url leads to a file that is there, in the document's folder.
bool isThere(const SiteDocument& document, const std::string& url);

} // namespace imgeo
