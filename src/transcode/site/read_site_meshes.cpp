// The public form of a site's meshes: plain arrays.

#include "imgeo/site.h"
#include "scene/shape_instances.h"
#include "transcode/site/read_meshes.h"

namespace imgeo {

namespace {

std::array<float, 3> arrayOf(Vec3f v) {
  return {v.x, v.y, v.z};
}

SiteMesh siteMeshOf(const Mesh& mesh) {
  SiteMesh result;
  result.name = mesh.name;
  result.topology = mesh.topology;
  for (const Vec3f& position : gather(mesh.positions, mesh.wedgePositions))
    result.positions.push_back(arrayOf(position));
  for (const Vec3f& normal : mesh.normals)
    result.normals.push_back(arrayOf(normal));
  for (std::size_t set = 0; set < texCoordSetCount(mesh); ++set) {
    auto& texCoords = set == 0 ? result.texCoords : result.furtherTexCoords.emplace_back();
    for (const Vec2f& texCoord : texCoordsOf(mesh, set))
      texCoords.push_back({texCoord.x, texCoord.y});
  }
  for (const Rgba& color : mesh.colors) {
    const auto [red, green, blue, alpha] = asRgba8(color);
    result.colors.push_back({red, green, blue, alpha});
  }
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    result.attributes.push_back({attribute.name, attribute.components, attribute.values});
  result.indices = mesh.corners;
  return result;
}

/// 4 x 4 matrix by columns.
std::array<double, 16> matrixOf(const Affine3d& map) {
  std::array<double, 16> matrix{};
  std::size_t next = 0;
  for (const Vec3d& column : {map.x, map.y, map.z, map.translation}) {
    for (const double number : {column.x, column.y, column.z})
      matrix[next++] = number;
    ++next;
  }
  matrix[15] = 1;
  return matrix;
}

} // namespace

SiteMeshes readSiteMeshes(const std::filesystem::path& site) {
  const SiteDocument document = openDocument(site);
  const Scene scene = readMeshes(document);
  SiteMeshes result;
  for (const Mesh& mesh : scene.meshes)
    result.meshes.push_back(siteMeshOf(mesh));
  for (const ShapeInstance& instance : shapeInstances(scene.graph))
    result.shapes.push_back({scene.graph.nodes[instance.node].name, shapeOf(scene.graph, instance.node).mesh,
                             matrixOf(instance.worldFromShape)});
  return result;
}

} // namespace imgeo
