#include "import/complete_import.h"

#include "base/error.h"
#include "import/source_name.h"
#include "import/warnings.h"
#include "scene/nesting.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

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

void completeCreases(Mesh& mesh, const ImportOptions& options) {
  if (options.creaseDegrees)
    mesh.creaseDegrees = options.creaseDegrees;
  else if (options.smoothsUnstated && mesh.creaseDegrees.value_or(0) == 0)
    mesh.creaseDegrees = smoothDegrees;
}

void completeImport(Imported& imported, bool isYUpInMetres, const ImportOptions& options, const std::string& name) {
  checkNestingLimit(imported.scene.graph, name);
  for (Mesh& mesh : imported.scene.meshes)
    completeCreases(mesh, options);
  if (isYUpInMetres) {
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
}

} // namespace imgeo
