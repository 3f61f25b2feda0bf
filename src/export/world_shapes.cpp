#include "export/world_shapes.h"

#include "scene/shape_instances.h"

#include <utility>

namespace imgeo {

Mesh transformed(Mesh mesh, const Affine3d& world) {
  for (Vec3f& position : mesh.positions)
    position = Vec3f(world.point(Vec3d(position)));
  const Affine3d normalMatrix = normalMatrixOf(world);
  for (Vec3f& normal : mesh.normals) {
    const Vec3d direction = normalMatrix.direction(Vec3d(normal));
    const double size = length(direction);
    normal = size > 0 ? Vec3f(direction * (1 / size)) : Vec3f{0, 0, 1};
  }
  if (mesh.topology == Topology::triangles && world.determinant() < 0)
    for (std::size_t corner = 0; corner + 2 < mesh.corners.size(); corner += 3)
      std::swap(mesh.corners[corner + 1], mesh.corners[corner + 2]);
  return mesh;
}

void forEachWorldShape(const Scene& scene, const VisitWorldShape& visit) {
  static const Appearance defaultAppearance;
  for (const ShapeInstance& instance : shapeInstances(scene.graph)) {
    const Shape& shape = shapeOf(scene.graph, instance.node);
    const Appearance& appearance = shape.appearance ? scene.graph.appearances.at(*shape.appearance) : defaultAppearance;
    const std::string& name = scene.graph.nodes[instance.node].name;
    const Mesh& mesh = scene.meshes[shape.mesh];
    if (instance.worldFromShape == Affine3d{})
      visit(name, appearance, mesh);
    else
      visit(name, appearance, transformed(mesh, instance.worldFromShape));
  }
}

} // namespace imgeo
