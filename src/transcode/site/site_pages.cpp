#include "transcode/site/site_pages.h"

#include "base/file.h"
#include "transcode/site/runtime.h"
#include "transcode/site/site_files.h"

#include <fmt/format.h>
#include <ranges>
#include <set>
#include <vector>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

std::size_t documentOf(const SceneGraph& graph, std::size_t inlineNode) {
  return *std::get<GenericNode>(graph.nodes[inlineNode].content).document;
}

} // namespace

void writeInlinedDocuments(SceneDocument& document, Target target, const fs::path& site) {
  // Lists the first Inline node of each document, outer documents before the documents that they inline. Files are
  // written in reverse order, since a file name is a hash of the content, which includes the names of inlined files.
  std::vector<std::size_t> firstInlines;
  std::set<std::size_t> listedDocuments;
  for (const std::size_t node : nodesInOrder(document.graph))
    if (inlinesDocument(document.graph.nodes[node]) && listedDocuments.insert(documentOf(document.graph, node)).second)
      firstInlines.push_back(node);
  for (const std::size_t node : firstInlines | std::views::reverse) {
    const std::string text =
        target == Target::x3dom ? writeInlinedX3domX3d(document, node) : writeInlinedX3d(document, node);
    std::string& url = document.graph.inlined[documentOf(document.graph, node)].url;
    url = contentName(asBytes(text)) + ".x3d";
    writeFile(site / url, asBytes(text));
  }
}

void writeX3domPages(const SceneDocument& document, const X3domRelease& release, const PagePictures& pictures,
                     const fs::path& site) {
  writeFile(site / stylesheetName, asBytes(pageStylesheet()));
  writeFile(site / sceneName, asBytes(writeX3domX3d(document)));
  writeFile(site / pageName, asBytes(writeX3domHtml(document, release.files, stylesheetName, pictures)));
}

Runtime writeRuntime(const fs::path& site) {
  Runtime runtime = runtimeOfSite();
  fs::create_directory(site / runtimeFolder);
  for (const RuntimeFile& file : runtime.files)
    writeFile(site / runtimeFolder / file.name, asBytes(file.text));
  writeFile(site / runtimeFolder / runtimeModuleName, asBytes(runtimeModuleText(runtime)));
  return runtime;
}

void writePages(const SceneDocument& document, const PagePictures& pictures, const fs::path& site) {
  const Runtime runtime = writeRuntime(site);
  const auto urlOf = [](const RuntimeFile& file) { return fmt::format("{}/{}", runtimeFolder, file.name); };
  writeFile(site / stylesheetName, asBytes(pageStylesheet()));
  writeFile(site / sceneName, asBytes(writeX3d(document)));
  writeFile(site / pageName, asBytes(writeHtml(document, {urlOf(runtime.page()),
                                                          stylesheetName,
                                                          {urlOf(runtime.shared())},
                                                          {urlOf(runtime.scene())},
                                                          urlOf(runtime.filesPart()),
                                                          urlOf(runtime.cutPart()),
                                                          pictures})));
}

} // namespace imgeo
