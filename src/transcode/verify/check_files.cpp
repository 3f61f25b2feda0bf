#include "transcode/verify/check_files.h"

#include "base/file.h"
#include "containers/levels/level_patches.h"
#include "transcode/node_geometry/open_whole_document.h"
#include "transcode/site/content_files.h"
#include "transcode/site/sequences.h"
#include "transcode/site/site_files.h"
#include "transcode/verify/compare_appearances.h"

#include <set>
#include <string>
#include <vector>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

std::set<std::string> urlsOfLevels(const SceneDocument& scene) {
  std::set<std::string> urls;
  for (const GeometryDescription& geometry : scene.geometries)
    if (geometry.levels)
      for (const auto& [url, role] : filesOfLevels(*geometry.levels))
        urls.insert(url);
  return urls;
}

/// Checks that the folders of levels have the names of their contents.
void checkLevelFolders(const SiteDocument& document, Findings& findings) {
  for (const GeometryDescription& geometry : document.scene.geometries) {
    if (!geometry.levels)
      continue;
    const fs::path folder = fs::path(geometry.levels->url).parent_path();
    FolderName name;
    for (const auto& [url, role] : filesOfLevels(*geometry.levels))
      name.add(fs::path(url).lexically_relative(folder).string(), readFile(fileOf(document, url)));
    if (folder.filename() != name.get())
      findings.add("{} does not hold what its name says (its content is {}).", folder.string(), name.get());
  }
}

} // namespace

bool checkFiles(const SiteDocument& document, bool isForeign, const SceneGraph& input, Findings& findings) {
  bool allPresent = true;
  std::vector<std::string> urls = isForeign ? std::vector<std::string>{} : pageFilesOf(document);
  for (const InlinedDocument& inlined : document.scene.graph.inlined)
    urls.push_back(inlined.url);
  const std::set<std::string> unread = unreadTextureUrls(input);
  for (const std::string& url : textureFilesOf(document.scene))
    if (!unread.contains(url))
      urls.push_back(url);
  for (const std::string& url : previewFilesOf(document.scene))
    urls.push_back(url);
  for (const NamedFile& file : geometryFilesOf(document.scene))
    urls.push_back(file.url);
  for (const SiteSequence& sequence : sequencesOf(document)) {
    urls.push_back(sequence.url);
    for (std::size_t i = 0; i < sequence.index.files.size(); ++i)
      urls.push_back(sequence.urlOf(i));
  }
  const std::set<std::string> levelFiles = urlsOfLevels(document.scene);
  for (const std::string& url : urls) {
    const fs::path file = fileOf(document, url);
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) {
      findings.add("{} is named by the document but is not there.", url);
      allPresent = false;
      continue;
    }
    const bool isInLevels = levelFiles.contains(url);
    if (isForeign || isInLevels || file.extension() == ".css" || file.filename() == runtimeModuleName)
      continue;
    const std::string stem = file.stem(), content = contentName(readFile(file));
    if (!stem.ends_with(content))
      findings.add("{} does not hold what its name says (its content is {}).", url, content);
  }
  if (allPresent && !isForeign)
    checkLevelFolders(document, findings);
  return allPresent;
}

void checkPictures(const SiteDocument& page, const SiteManifest& manifest, Findings& findings) {
  for (const std::string name : {iconName, pictureName}) {
    std::error_code ignored;
    const bool isThere = fs::is_regular_file(page.root / name, ignored);
    if (!manifest.pictures) { // which content it should have is not known
      if (!isThere && page.text.find("\"" + name + "\"") != page.text.npos)
        findings.add("{} is named by the document but is not there.", name);
      continue;
    }
    const auto stated = manifest.pictures->find(name);
    if (stated == manifest.pictures->end()) {
      if (isThere)
        findings.add("{} is not of this site: {} does not name it.", name, manifestName);
    } else if (!isThere) {
      findings.add("{} is named by {} but is not there.", name, manifestName);
    } else if (const std::string content = contentName(readFile(page.root / name)); content != stated->second) {
      findings.add("{} is not the picture that convert wrote: its content is {}, {} says {}.", name, content,
                   manifestName, stated->second);
    }
  }
}

void checkDocuments(const SiteDocument& page, bool isWhole, Findings& findings) {
  if (page.name == sceneName)
    return;
  const SiteDocument scene = isWhole ? openWholeDocument(page.root / sceneName) : openDocument(page.root / sceneName);
  if (writeX3d(scene.scene) != writeX3d(page.scene))
    findings.add("{} and {} differ.", pageName, sceneName);
}

} // namespace imgeo
