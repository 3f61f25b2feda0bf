#include "import/x3d/inlines.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace imgeo::x3d {

namespace fs = std::filesystem;

void Inlines::requireNoCycle(const fs::path& file) const {
  if (std::ranges::find(options_.inlinedBy, file) != options_.inlinedBy.end())
    throw Error(ErrorKind::malformed, "", fmt::format("names {}, which contains it", file.filename().string()));
  if (options_.inlinedBy.size() > maxInlineDepth)
    throw Error(ErrorKind::unsupported, "",
                fmt::format("names {}, more than {} documents deep", file.filename().string(), maxInlineDepth));
}

Inlines::Document Inlines::read(const std::string& url) {
  std::error_code ignored;
  const fs::path file = references_.fileOf(url), real = fs::weakly_canonical(file, ignored);
  if (const auto found = read_.find(real); found != read_.end())
    return found->second;
  requireNoCycle(real);
  ImportOptions options = options_;
  options.within = options_.within.empty() ? options_.folder : options_.within;
  options.origin = Vec3d{0, 0, 0}; // models stay where the document has them
  Imported imported = importFile(file, options);

  SceneGraph& graph = scene_.graph;
  Document document;
  const std::size_t meshesBefore = scene_.meshes.size();
  DocumentHead& head = imported.scene.graph.head;
  document.roots = append(graph, std::move(imported.scene.graph), meshesBefore);
  document.index = graph.inlined.size();
  graph.inlined.push_back({"", std::move(head)});
  if (graph.inlined.size() > maxInlinedDocuments)
    throw Error(ErrorKind::limit, file.string(),
                fmt::format("the scene inlines more than {} documents", maxInlinedDocuments));
  std::ranges::move(imported.scene.meshes, std::back_inserter(scene_.meshes));
  for (const std::string& warning : imported.warnings)
    warnings_.push_back(fmt::format("{}: {}", file.filename().string(), warning));
  return read_[real] = document;
}

} // namespace imgeo::x3d
