#include "base/bytes.h"
#include "base/error.h"
#include "documents/documents.h"

#include <cstdlib>

/// Fuzzes readScene: a scene that is read can be written as X3D and as HTML, and read again with the same nodes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  const auto require = [](bool condition) {
    if (!condition)
      std::abort();
  };
  SceneDocument read;
  try {
    read = readScene(asText({data, size}), "fuzz.x3d");
  } catch (const Error& error) {
    require(!error.message().empty() && error.location().starts_with("fuzz.x3d"));
    return 0;
  }
  for (const std::string& text : {writeX3d(read), writeHtml(read, {"runtime.js", "style.css"})}) {
    const SceneDocument again = readScene(text, "again");
    require(again.graph.title == read.graph.title && again.graph.headlight == read.graph.headlight);
    const std::vector<std::size_t> nodes = nodesInOrder(read.graph), nodesAgain = nodesInOrder(again.graph);
    require(nodes.size() == nodesAgain.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Node &node = read.graph.nodes[nodes[i]], &nodeAgain = again.graph.nodes[nodesAgain[i]];
      require(node.content.index() == nodeAgain.content.index());
      const Shape* shape = std::get_if<Shape>(&node.content);
      if (!shape)
        continue;
      const Shape& shapeAgain = std::get<Shape>(nodeAgain.content);
      require(again.geometries.at(shapeAgain.mesh).patches.size() == read.geometries.at(shape->mesh).patches.size());
      require(!shape->appearance || again.graph.appearances.at(*shapeAgain.appearance).material ==
                                        read.graph.appearances.at(*shape->appearance).material);
    }
  }
  return 0;
}
