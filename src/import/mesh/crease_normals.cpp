#include "import/mesh/crease_normals.h"

#include "import/x3d/faces.h"

#include <array>
#include <bit>
#include <map>

namespace imgeo {

Mesh withCreaseNormals(const Mesh& mesh, double creaseAngle) {
  assert(mesh.topology == Topology::triangles && mesh.normals.empty() && mesh.namedAttributes.empty());
  x3d::VertexData data;
  data.texCoords = mesh.texCoords;
  for (std::size_t set = 1; set < texCoordSetCount(mesh); ++set)
    data.furtherTexCoords.push_back(texCoordsOf(mesh, set));
  data.texCoordMappings = mesh.texCoordMappings;
  data.colors = mesh.colors;
  data.colorComponents = mesh.colorComponents;
  std::vector<std::uint32_t> mergedPositions;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> indexOfBits;
  for (const Vec3f& p : mesh.positions) {
    const std::array bits{std::bit_cast<std::uint32_t>(p.x + 0), std::bit_cast<std::uint32_t>(p.y + 0),
                          std::bit_cast<std::uint32_t>(p.z + 0)}; // + 0 makes -0 equal 0
    const auto [found, isNew] = indexOfBits.try_emplace(bits, static_cast<std::uint32_t>(data.positions.size()));
    if (isNew)
      data.positions.push_back(p);
    mergedPositions.push_back(found->second);
  }
  x3d::Faces faces;
  for (const std::uint32_t wedge : mesh.corners) {
    x3d::Corner corner;
    corner.position = mergedPositions[mesh.wedgePositions[wedge]];
    if (!mesh.texCoords.empty())
      corner.texCoord = wedge;
    if (!mesh.colors.empty())
      corner.color = wedge;
    faces.corners.push_back(corner);
    if (faces.corners.size() % 3 == 0)
      faces.ends.push_back(faces.corners.size());
  }
  x3d::addCreaseNormals(data, faces, creaseAngle);
  std::size_t fans = 0; // stays 0: all faces are triangles
  Mesh result = x3d::meshOf(data, faces, fans);
  result.name = mesh.name;
  return result;
}

} // namespace imgeo
