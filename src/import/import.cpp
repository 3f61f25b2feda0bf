#include "import/import.h"

#include "base/error.h"
#include "base/file_view.h"
#include "import/archive/gzip.h"
#include "import/dem/dem.h"
#include "import/format.h"
#include "import/source_name.h"
#include "import/text/utf16.h"
#include "import/warnings.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

/// Makes node names unique, since they become DEFs: "wheel", "wheel-2", ...
void makeNamesUnique(SceneGraph& graph) {
  std::map<std::string, std::size_t> next; // name -> the number to try for the next node of that name
  for (const std::size_t index : nodesOfDocument(graph, graph.roots)) {
    std::string& name = graph.nodes[index].name;
    if (name.empty())
      continue;
    const std::string original = name;
    while (!next.try_emplace(name, 2).second)
      name = fmt::format("{}-{}", original, next[original]++);
  }
}

} // namespace

Imported importBytes(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  Bytes unpacked;
  if (isGzip(bytes)) {
    unpacked = gunzip(bytes, name);
    bytes = unpacked;
  }
  if (asText(bytes).starts_with("\xef\xbb\xbf"))
    bytes = bytes.subspan(3); // byte order mark
  const std::optional<Bytes> decoded = holdsRawNumbers(name) ? std::nullopt : utf8OfUtf16(bytes);
  if (decoded)
    bytes = *decoded;
  if (bytes.empty())
    throw Error(ErrorKind::truncated, name, "the file is empty");

  const Format& format = formatOf(bytes, name);
  Imported imported = format.read(bytes, name, options);
  if (format.isYUpInMetres) {
    imported.up = AxisDirection::y;
    imported.metres = 1;
  }
  const auto hasElements = [&](const ShapeInstance& instance) {
    return !imported.scene.meshes[shapeOf(imported.scene.graph, instance.node).mesh].corners.empty();
  };
  if (!imported.scene.graph.isComplete && std::ranges::none_of(shapeInstances(imported.scene.graph, name), hasElements))
    throw Error(ErrorKind::malformed, name,
                "the file has no triangles, lines or points" +
                    (imported.warnings.empty() ? "" : "; " + withoutFullStop(imported.warnings[0])));
  checkShapeInstanceLimit(imported.scene.graph, name);
  makeNamesUnique(imported.scene.graph);
  if (imported.scene.graph.title.empty())
    imported.scene.graph.title = stemOf(name);
  return imported;
}

Imported importFile(const std::filesystem::path& path, const ImportOptions& options) {
  ImportOptions fileOptions = options;
  fileOptions.folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code ignored;
  fileOptions.inlinedBy.push_back(std::filesystem::weakly_canonical(path, ignored));
  const FileView file(path);
  return importBytes(file.bytes(), path.string(), fileOptions);
}

} // namespace imgeo
