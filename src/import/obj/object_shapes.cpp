#include "import/obj/object_shapes.h"

#include "import/mesh/add_shape.h"
#include "import/source_name.h"
#include "import/warnings.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace imgeo {

namespace {

void addObject(Scene& scene, std::span<const ObjObject> subsets, const ObjMeshSource& meshOf, ObjMaterials& materials,
               const std::string& fileName) {
  std::vector<std::size_t> shapes;
  for (const ObjObject& subset : subsets)
    for (const Topology topology : {Topology::triangles, Topology::lines}) {
      std::optional<Mesh> mesh = meshOf(subset, topology);
      if (!mesh)
        continue;
      mesh->name = subset.name.empty() ? stemOf(fileName) : subset.name;
      Shape shape;
      shape.mesh = scene.meshes.size();
      if (!subset.material.empty())
        shape.appearance = materials.appearance(subset.material);
      scene.meshes.push_back(*std::move(mesh));
      shapes.push_back(addNode(scene.graph, {subsets.size() == 1 ? subset.name : "", shape, {}, ""}));
    }
  if (subsets.size() == 1)
    std::ranges::copy(shapes, std::back_inserter(scene.graph.roots));
  else
    addRoot(scene.graph, {subsets.front().name, Group{}, std::move(shapes), ""});
}

} // namespace

void addObjectShapes(Scene& scene, std::span<const ObjObject> subsets, const ObjMeshSource& meshOf,
                     ObjMaterials& materials, const std::string& fileName) {
  for (auto first = subsets.begin(); first != subsets.end();) {
    const auto last =
        std::find_if(first, subsets.end(), [&](const ObjObject& subset) { return subset.index != first->index; });
    addObject(scene, {first, last}, meshOf, materials, fileName);
    first = last;
  }
}

void warnOfPartialNormals(std::vector<std::string>& warnings, std::size_t objects) {
  if (objects > 0)
    warnings.push_back(fmt::format("The normals of {} left out: some corners have none.",
                                   counted(objects, "object were", "objects were")));
}

} // namespace imgeo
