#include "transcode/site/site_document.h"

#include "base/data_url.h"
#include "base/error.h"
#include "base/file.h"
#include "base/first_readable.h"
#include "containers/choose_urls.h"
#include "containers/levels/level_patches.h"
#include "images/decode_image.h"
#include "transcode/site/site_files.h"

#include <algorithm>
#include <set>
#include <utility>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t maxInlinedDocuments = 1000; // the limit of src/import too

/// Reads inlined documents and makes their roots the children of the Inline nodes. Nested Inlines are appended to
/// graph.inlined during the loop.
void addInlined(SiteDocument& document, const ReadNodeGeometry& readNode) {
  SceneGraph& graph = document.scene.graph;
  for (std::size_t index = 0; index < graph.inlined.size(); ++index) {
    const std::string url = graph.inlined[index].url;
    const fs::path file = document.root / url;
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored))
      continue;
    if (index >= maxInlinedDocuments)
      throw Error(ErrorKind::limit, file.string(), "documents inline one another without end");
    InlinedText inlined{url, std::string(asText(readFile(file)))};
    const std::vector<std::size_t> roots = append(document.scene, readScene(inlined.text, file.string(), readNode));
    for (Node& node : graph.nodes)
      if (const GenericNode* generic = std::get_if<GenericNode>(&node.content); generic && generic->document == index)
        node.children = roots;
    document.inlined.push_back(std::move(inlined));
  }
}

/// The values of a member of all images, each once, without empty ones and URLs of other hosts.
std::vector<std::string> ownFilesOf(const SceneDocument& scene, std::string ImageFile::*member) {
  std::vector<std::string> urls;
  std::set<std::string> seen;
  for (const ImageFile& image : scene.graph.images) {
    const std::string& url = image.*member;
    const bool isElsewhere = url.empty() || url.find(':') != url.npos || url.starts_with("//");
    if (!isElsewhere && seen.insert(url).second)
      urls.push_back(url);
  }
  return urls;
}

bool leadsOutOfFolder(const std::string& url) {
  const fs::path path = fs::path(url).lexically_normal();
  return path.empty() || path.is_absolute() || *path.begin() == ".." || url.find(':') != url.npos;
}

/// Whether the file of an image can be read and shown.
bool isReadableImage(const FetchFile& fetch, const std::string& url) {
  try {
    return isShownInPages(fetch(url));
  } catch (const Error&) {
    return false;
  }
}

/// Reads the indexes of levels. Throws Error.
void readAllLevels(SiteDocument& document) {
  for (GeometryDescription& geometry : document.scene.geometries)
    if (geometry.levels)
      readLevels(geometry, fetchFrom(document));
}

/// Chooses, of files with several URLs, the first that can be read and decoded, as pages do; of an image, the first of
/// all where none can. Throws Error, which names all, where none of the URLs of a file of geometry can.
void chooseFiles(SiteDocument& document) {
  const FetchFile fetch = fetchFrom(document);
  for (GeometryDescription& geometry : document.scene.geometries)
    if (const std::vector<Error> errors = chooseUrls(geometry, fetch); !errors.empty())
      throw joined(errors);
  for (ImageFile& image : document.scene.graph.images) {
    std::vector<std::string> urls = std::exchange(image.furtherUrls, {});
    if (urls.empty())
      continue;
    urls.insert(urls.begin(), image.url);
    const auto found = std::ranges::find_if(urls, [&](const std::string& url) { return isReadableImage(fetch, url); });
    if (found != urls.end())
      image.url = *found;
  }
}

} // namespace

SiteDocument openDocument(const fs::path& site, const ReadNodeGeometry& readNode) {
  fs::path file = site;
  std::error_code ignored;
  if (fs::is_directory(site, ignored)) {
    file = site / pageName;
    if (!fs::exists(file, ignored) && fs::exists(site / sceneName, ignored))
      file = site / sceneName;
    if (!fs::exists(file, ignored))
      throw Error(ErrorKind::io, site.string(), "is no site: it holds neither index.html nor scene.x3d");
  }
  SiteDocument document{file.parent_path(), file.filename(), std::string(asText(readFile(file))), {}, {}};
  document.scene = readScene(document.text, file.string(), readNode);
  addInlined(document, readNode);
  chooseFiles(document);
  readAllLevels(document);
  return document;
}

std::vector<NamedFile> geometryFilesOf(const SceneDocument& scene) {
  std::vector<NamedFile> files;
  std::set<std::string> seen;
  const auto add = [&](Role role, const Reference& reference) {
    if (!isDataUrl(reference.url) && seen.insert(reference.url).second)
      files.push_back({reference.url, role});
  };
  for (const GeometryDescription& geometry : scene.geometries) {
    if (geometry.base)
      add(Role::base, *geometry.base);
    if (geometry.levels)
      for (const auto& [url, role] : filesOfLevels(*geometry.levels))
        add(role, {url, {}});
    for (const PatchDescription& patch : geometry.patches)
      visitReferences(patch, add);
  }
  return files;
}

std::vector<std::string> textureFilesOf(const SceneDocument& scene) {
  return ownFilesOf(scene, &ImageFile::url);
}

std::vector<std::string> previewFilesOf(const SceneDocument& scene) {
  return ownFilesOf(scene, &ImageFile::preview);
}

std::vector<std::string> pageFilesOf(std::string_view html) {
  // Searches the text for src and href attributes whose values end in .js or .css.
  std::vector<std::string> urls;
  for (const std::string_view attribute : {"src=\"", "href=\""})
    for (std::size_t at = html.find(attribute); at != html.npos; at = html.find(attribute, at)) {
      at += attribute.size();
      const std::string_view url = html.substr(at, html.find('"', at) - at);
      const bool isModuleOrStyle = url.ends_with(".js") || url.ends_with(".css");
      const bool isLocal = url.find(':') == url.npos && !url.starts_with("//");
      const bool isX3dom = url.ends_with("x3dom.js") || url.ends_with("x3dom.css");
      if (isModuleOrStyle && isLocal && !isX3dom && std::ranges::find(urls, url) == urls.end())
        urls.emplace_back(url);
    }
  return urls;
}

std::vector<std::string> pageFilesOf(const SiteDocument& document) {
  if (document.name == sceneName)
    return {};
  std::vector<std::string> urls = pageFilesOf(document.text);
  const std::string runtimePrefix = std::string(runtimeFolder) + "/";
  if (std::ranges::any_of(urls, [&](const std::string& url) { return url.starts_with(runtimePrefix); }))
    urls.push_back(runtimePrefix + runtimeModuleName);
  // Modules import others as "./imgeo-....js", with quotation marks of any kind.
  constexpr std::string_view name = "./imgeo-";
  for (std::size_t i = 0; i < urls.size(); ++i) {
    std::error_code ignored;
    const fs::path file = fileOf(document, urls[i]);
    if (!urls[i].ends_with(".js") || !fs::is_regular_file(file, ignored))
      continue;
    const Bytes bytes = readFile(file);
    const std::string_view text = asText(bytes);
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
      const std::size_t begin = at + std::string_view("./").size();
      const std::string_view other =
          text.substr(begin, std::min(text.find_first_of("\"'`", begin), text.size()) - begin);
      std::string url = (fs::path(urls[i]).parent_path() / other).string();
      if (other.ends_with(".js") && std::ranges::find(urls, url) == urls.end())
        urls.push_back(std::move(url));
    }
  }
  return urls;
}

fs::path fileOf(const SiteDocument& document, const std::string& url) {
  if (leadsOutOfFolder(url))
    throw Error(ErrorKind::unsupported, (document.root / document.name).string(),
                "refers to \"" + url + "\", which is not a file of the site");
  return document.root / fs::path(url).lexically_normal();
}

bool exists(const SiteDocument& document, const std::string& url) {
  std::error_code ignored;
  return !leadsOutOfFolder(url) && fs::is_regular_file(fileOf(document, url), ignored);
}

FetchFile fetchFrom(const SiteDocument& document) {
  return [&document](const std::string& url) {
    return isDataUrl(url) ? bytesOfDataUrl(url, url) : readFile(fileOf(document, url));
  };
}

} // namespace imgeo
