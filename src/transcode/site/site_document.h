#pragma once
// Opens the document of a finished site and the files that the document names. Safe for untrusted bytes; functions
// throw Error.

#include "containers/container_reader.h"
#include "documents/documents.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// A document that an Inline node includes.
struct InlinedText {
  std::string url, text;
};

/// A document and the folder its urls are relative to.
struct SiteDocument {
  std::filesystem::path root;
  std::string name; ///< of the document inside `root`
  std::string text;
  SceneDocument scene;              ///< including the scenes of inlined documents
  std::vector<InlinedText> inlined; ///< those that exist
};

/// Opens a site's directory (its index.html, or else its scene.x3d) or a document, and the documents that it inlines,
/// as far as they exist in its folder. `readNode`: see readScene().
SiteDocument openDocument(const std::filesystem::path& site, const ReadNodeGeometry& readNode = {});

/// A file that a document names, and its role there.
struct NamedFile {
  std::string url;
  Role role = Role::coord;
};

/// Every geometry file of a scene once, in the order of first mention, without data: URLs.
std::vector<NamedFile> geometryFilesOf(const SceneDocument& scene);

/// URLs of texture images, each once, in the order of first mention, without those of other hosts.
std::vector<std::string> textureFilesOf(const SceneDocument& scene);

/// URLs of the previews of texture images, with the same order and omissions.
std::vector<std::string> previewFilesOf(const SceneDocument& scene);

/// URLs of the runtime modules and the stylesheet that a page names, without those of other hosts and of X3DOM.
std::vector<std::string> pageFilesOf(std::string_view html);

/// The same for a site, with the modules that those modules import, and the one that other people's pages load. Empty
/// if the document is not a page.
std::vector<std::string> pageFilesOf(const SiteDocument& document);

/// The path of a relative URL. Throws Error{unsupported} for a URL that leads out of the document's folder.
std::filesystem::path fileOf(const SiteDocument& document, const std::string& url);

/// A function that reads the file of a URL, or the bytes of a data: URL. `document` must outlive it.
FetchFile fetchFrom(const SiteDocument& document);

/// Whether a relative URL names an existing file in the document's folder.
bool exists(const SiteDocument& document, const std::string& url);

} // namespace imgeo
