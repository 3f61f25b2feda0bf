#include "import/assimp/meshes.h"

#include "base/error.h"
#include "import/assimp/conversions.h"
#include "import/assimp/deformation.h"
#include "import/mesh/texcoord_mapping.h"
#include "import/mesh/triangulate.h"
#include "import/mesh/unit_normal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <set>

namespace imgeo {

const AssimpMeshes::Nodes& AssimpMeshes::add(const aiMesh& source) {
  Nodes& nodes = nodes_.emplace_back();
  const std::optional<std::size_t> appearance = materials_.appearance(source.mMaterialIndex);
  const std::vector<unsigned> texCoordSets = keptTexCoordSets(source, appearance);
  for (const Topology topology : allTopologies) {
    Mesh mesh;
    mesh.topology = topology;
    addCorners(source, mesh);
    if (mesh.corners.empty())
      continue;
    addVertices(source, texCoordSets, mesh);
    if (!isDeformed(mesh))
      mesh.creaseDegrees = manMadeCreaseDegrees; // what these formats mostly hold
    Shape shape;
    shape.mesh = scene_.meshes.size();
    shape.appearance = appearance;
    shape.solid = materials_.isSolid(source.mMaterialIndex);
    scene_.meshes.push_back(std::move(mesh));
    const std::size_t targets = displacementCount(scene_.meshes.back());
    while (nodes.displacers.size() < targets)
      nodes.displacers.push_back(displacerNode(*source.mAnimMeshes[nodes.displacers.size()]));
    std::vector<std::size_t> own(nodes.displacers.begin(),
                                 nodes.displacers.begin() + static_cast<std::ptrdiff_t>(targets));
    nodes.shapes.push_back(addNode(scene_.graph, {nameOf(source.mName), shape, std::move(own), ""}));
  }
  nodes.isSkinned = std::ranges::any_of(nodes.shapes, [&](std::size_t shape) {
    return jointSetCount(scene_.meshes[shapeOf(scene_.graph, shape).mesh]) > 0;
  });
  furtherColors += source.GetNumColorChannels() > 1;
  return nodes;
}

std::size_t AssimpMeshes::displacerNode(const aiAnimMesh& target) {
  const std::string name = nameOf(target.mName);
  unknownWeights += isFbx_;
  const double weight = isFbx_ ? 0 : target.mWeight; // of FBX Assimp 5.2 reports 1, whatever the file states
  return addNode(scene_.graph, {name.empty() ? "displacer" : name, Displacer{name, weight}, {}, ""});
}

std::vector<unsigned> AssimpMeshes::keptTexCoordSets(const aiMesh& source, std::optional<std::size_t> appearance) {
  std::set<std::string> used;
  if (appearance)
    for (const TextureUse& texture : scene_.graph.appearances[*appearance].textures)
      used.insert(texture.mapping);
  std::vector<unsigned> kept;
  unsigned present = 0;
  for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set) {
    if (!source.HasTextureCoords(set))
      continue;
    ++present;
    const bool isUsed = used.empty() ? present == 1 : used.contains(mappingOf(set));
    if (kept.size() < maxTexCoordSets && (isUsed || choice_.has(fmt::format("TEXCOORD_{}", set))))
      kept.push_back(set);
  }
  if (kept.empty() && source.HasTextureCoords(0)) // textures whose set is missing use the first
    kept.push_back(0);
  furtherTexCoords += present > kept.size();
  return kept;
}

void AssimpMeshes::addCorners(const aiMesh& source, Mesh& mesh) {
  const std::uint32_t cornerCount = cornersPerElement(mesh.topology);
  std::vector<Vec3f> ring;
  std::vector<std::uint32_t> triangles;
  for (unsigned i = 0; i < source.mNumFaces; ++i) {
    const aiFace& face = source.mFaces[i];
    const bool isPolygon = mesh.topology == Topology::triangles && face.mNumIndices > 3;
    if (face.mNumIndices != cornerCount && !isPolygon)
      continue;
    for (unsigned c = 0; c < face.mNumIndices; ++c)
      if (face.mIndices[c] >= source.mNumVertices)
        throw Error(ErrorKind::malformed, name_,
                    fmt::format("face {} of a mesh names vertex {} of {}", i, face.mIndices[c], source.mNumVertices));
    if (!isPolygon) {
      mesh.corners.insert(mesh.corners.end(), face.mIndices, face.mIndices + face.mNumIndices);
      continue;
    }
    ring.clear(), triangles.clear();
    for (unsigned c = 0; c < face.mNumIndices; ++c)
      ring.push_back(Vec3f(vectorOf(source.mVertices[face.mIndices[c]])));
    fans += !triangulate(ring, triangles);
    for (const std::uint32_t corner : triangles)
      mesh.corners.push_back(face.mIndices[corner]);
  }
}

void AssimpMeshes::addVertices(const aiMesh& source, const std::vector<unsigned>& texCoordSets, Mesh& mesh) {
  std::vector<std::uint32_t> local(source.mNumVertices, ~0u), vertices;
  for (std::uint32_t& corner : mesh.corners) {
    std::uint32_t& index = local[corner];
    if (index == ~0u) {
      index = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.wedgePositions.push_back(index);
      vertices.push_back(corner);
      addVertex(source, corner, texCoordSets, mesh);
    }
    corner = index;
  }
  // What Assimp gives vertices of AMF files without colours, which would be invisible.
  if (std::ranges::all_of(mesh.colors, [](const Rgba& color) { return color == Rgba{0, 0, 0, 0}; }))
    mesh.colors.clear();
  const bool isOpaque = std::ranges::all_of(mesh.colors, [](const Rgba& color) { return color.a == 1; });
  mesh.colorComponents = isOpaque ? 3 : 4;
  if (texCoordSets.size() > 1) // a single set serves all textures
    for (const unsigned set : texCoordSets)
      mesh.texCoordMappings.push_back(mappingOf(set));
  if (source.mNumBones > 0)
    damagedSkins += !addBones(source, vertices, mesh);
  if (source.mNumAnimMeshes > 0)
    damagedTargets += !addTargets(source, vertices, mesh);
}

void AssimpMeshes::addVertex(const aiMesh& source, std::uint32_t vertex, const std::vector<unsigned>& texCoordSets,
                             Mesh& mesh) {
  const aiVector3D& p = source.mVertices[vertex];
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
    throw Error(ErrorKind::malformed, name_, fmt::format("vertex {} of a mesh is not a number", vertex));
  mesh.positions.push_back(Vec3f(vectorOf(p)));
  if (source.HasNormals() && mesh.topology == Topology::triangles) {
    mesh.normals.push_back(Vec3f(vectorOf(source.mNormals[vertex])));
    unusableNormals += !makeUnit(mesh.normals.back());
  }
  for (std::size_t i = 0; i < texCoordSets.size(); ++i) {
    const aiVector3D& t = source.mTextureCoords[texCoordSets[i]][vertex];
    texCoordsOf(mesh, i).push_back(std::isfinite(t.x) && std::isfinite(t.y) ? Vec2f{t.x, t.y} : Vec2f{});
  }
  if (source.HasVertexColors(0)) {
    const aiColor4D& color = source.mColors[0][vertex];
    mesh.colors.emplace_back(channelOf(color.r), channelOf(color.g), channelOf(color.b), channelOf(color.a));
  }
}

} // namespace imgeo
