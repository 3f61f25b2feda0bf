#include "transcode/source/scene_names.h"

#include <string_view>
#include <vector>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// The input's file name without extensions: "statue" for "scans/statue.ply.gz".
std::string titleFrom(const fs::path& input) {
  if (input == "-")
    return "Untitled";
  fs::path name = input.filename();
  if (name.extension() == ".gz")
    name = name.stem();
  return name.stem();
}

} // namespace

fs::path withoutNumber(const fs::path& frame) {
  std::string stem = frame.stem();
  while (!stem.empty() && std::string_view("0123456789-_. ").find(stem.back()) != std::string_view::npos)
    stem.pop_back();
  return stem.empty() ? frame : frame.parent_path() / (stem + frame.extension().string());
}

void nameScene(SceneGraph& graph, const std::string& statedTitle, const fs::path& input) {
  if (!statedTitle.empty())
    graph.title = statedTitle;
  else if (graph.title.empty())
    graph.title = titleFrom(input);
  if (graph.isComplete)
    return;
  // Scripts find shapes by name, and files with one object rarely name it.
  const std::vector<std::size_t> shapes = shapeNodes(graph);
  if (shapes.size() == 1 && graph.nodes[shapes[0]].name.empty())
    graph.nodes[shapes[0]].name = graph.title;
}

} // namespace imgeo
