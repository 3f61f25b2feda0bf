#include "transcode/site/read_meshes.h"

#include "base/error.h"
#include "containers/order_by_file.h"
#include "containers/read_mesh.h"
#include "documents/equal_geometries.h"
#include "documents/mixed_geometries.h"
#include "transcode/site/listed_elements.h"

#include <fmt/format.h>
#include <utility>

namespace imgeo {

Scene readMeshes(const SiteDocument& document) {
  SceneDocument split = document.scene;
  shareEqualGeometries(split);
  splitMixedGeometries(split);
  Scene scene;
  scene.graph = std::move(split.graph);
  const std::size_t count = split.geometries.size();
  scene.meshes.resize(count);
  std::vector<bool> isEmpty(count);
  const std::string location = (document.root / document.name).string();
  const ContainerReader reader(fetchFrom(document));
  for (const std::size_t i : orderByFile(split.geometries)) {
    scene.meshes[i] = readMesh(reader, split.geometries[i], location);
    isEmpty[i] = scene.meshes[i].corners.empty();
  }
  for (const std::size_t node : shapeNodes(scene.graph)) {
    Mesh& mesh = scene.meshes[shapeOf(scene.graph, node).mesh];
    if (mesh.name.empty())
      mesh.name = scene.graph.nodes[node].name;
  }
  removeShapes(scene.graph, isEmpty);
  if (shapeNodes(scene.graph).empty()) {
    const std::string inDocument = listed(document.scene.geometryElements);
    throw Error(ErrorKind::malformed, location,
                inDocument.empty() ? "draws nothing"
                                   : fmt::format("has no geometry of which a mesh can be made, only {}", inDocument));
  }
  return scene;
}

} // namespace imgeo
