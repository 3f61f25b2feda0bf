#include "import/obj/object.h"

#include <algorithm>

namespace imgeo {

namespace {
constexpr std::uint32_t none = ObjCorner::none;
}

ObjMeshBuilder::ObjMeshBuilder(const ObjContent& content)
    : content_(content), localPosition_(content.positions.size(), none) {
  std::size_t meshes = 0;
  for (const ObjObject& object : content.objects)
    meshes += !object.triangles.empty() + !object.lines.empty();
  isOnlyMesh_ = meshes == 1;
}

Mesh ObjMeshBuilder::build(const ObjObject& object, Topology topology) {
  const std::vector<ObjCorner>& corners = topology == Topology::lines ? object.lines : object.triangles;
  Mesh mesh;
  mesh.name = object.name;
  mesh.topology = topology;
  mesh.creaseDegrees.reset();
  hasTexCoords_ = std::ranges::any_of(corners, [](const ObjCorner& c) { return c.texCoord != none; });
  const auto normals = std::ranges::count_if(corners, [](const ObjCorner& c) { return c.normal != none; });
  hasNormals_ = static_cast<std::size_t>(normals) == corners.size();
  objectsWithPartialNormals += normals > 0 && !hasNormals_;
  firstWedge_.clear(), nextWedge_.clear(), wedgeKeys_.clear(), overflowWedges_.clear();

  if (isOnlyMesh_)
    addAllPositions(mesh);
  mesh.corners.reserve(corners.size());
  for (const ObjCorner& corner : corners)
    mesh.corners.push_back(findOrAddWedge(mesh, corner));
  for (const ObjCorner& corner : corners)
    localPosition_[corner.position] = none;
  return mesh;
}

/// Adds all positions of the file, and their wedges where corners have positions only.
void ObjMeshBuilder::addAllPositions(Mesh& mesh) {
  mesh.positions = content_.positions;
  firstWedge_.assign(mesh.positions.size(), none);
  for (std::uint32_t i = 0; i < localPosition_.size(); ++i)
    localPosition_[i] = i;
  if (hasTexCoords_ || hasNormals_)
    return;
  for (std::uint32_t i = 0; i < localPosition_.size(); ++i)
    findOrAddWedge(mesh, {i, none, none});
}

std::uint32_t ObjMeshBuilder::findOrAddWedge(Mesh& mesh, const ObjCorner& corner) {
  std::uint32_t& local = localPosition_[corner.position];
  if (local == none) {
    local = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(content_.positions[corner.position]);
    firstWedge_.push_back(none);
  }
  const std::uint32_t texCoord = hasTexCoords_ ? corner.texCoord : none;
  const std::uint32_t normal = hasNormals_ ? corner.normal : none;
  std::uint32_t length = 0;
  for (std::uint32_t w = firstWedge_[local]; w != none; w = nextWedge_[w], ++length)
    if (wedgeKeys_[w].texCoord == texCoord && wedgeKeys_[w].normal == normal)
      return w;

  const auto added = static_cast<std::uint32_t>(mesh.wedgeCount());
  constexpr std::uint32_t maxListLength = 32;
  const bool isListed = length < maxListLength;
  if (!isListed) {
    const auto [found, isNew] = overflowWedges_.try_emplace({local, texCoord, normal}, added);
    if (!isNew)
      return found->second;
  }
  mesh.wedgePositions.push_back(local);
  nextWedge_.push_back(firstWedge_[local]);
  if (isListed)
    firstWedge_[local] = added;
  wedgeKeys_.push_back({local, texCoord, normal});
  if (hasTexCoords_)
    mesh.texCoords.push_back(texCoord == none ? Vec2f{} : content_.texCoords[texCoord]);
  if (hasNormals_)
    mesh.normals.push_back(content_.normals[normal]);
  if (!content_.colors.empty())
    mesh.colors.push_back(content_.colors[corner.position]);
  return added;
}

} // namespace imgeo
