#include "import/assimp/deformation.h"

#include "import/assimp/conversions.h"

#include <algorithm>
#include <assimp/scene.h>
#include <cmath>

namespace imgeo {

namespace {

struct Influence {
  std::uint32_t joint;
  float weight;
};

bool isFiniteMatrix(const aiMatrix4x4& m) {
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      if (!std::isfinite(m[row][column]))
        return false;
  return true;
}

/// The bones of each vertex, those with the largest weights first; empty if any is damaged.
std::vector<std::vector<Influence>> influencesOf(const aiMesh& source) {
  std::vector<std::vector<Influence>> influences(source.mNumVertices);
  for (unsigned b = 0; b < source.mNumBones; ++b)
    for (unsigned i = 0; i < source.mBones[b]->mNumWeights; ++i) {
      const aiVertexWeight& weight = source.mBones[b]->mWeights[i];
      if (weight.mVertexId >= source.mNumVertices || !std::isfinite(weight.mWeight) || weight.mWeight < 0)
        return {};
      if (weight.mWeight > 0)
        influences[weight.mVertexId].push_back({b, weight.mWeight});
    }
  for (std::vector<Influence>& list : influences) {
    std::ranges::stable_sort(list, std::greater{}, &Influence::weight);
    list.resize(std::min(list.size(), 4 * maxJointSets));
  }
  return influences;
}

std::vector<float> differences(const aiVector3D* from, const aiVector3D* to, std::span<const std::uint32_t> vertices) {
  std::vector<float> values;
  for (const std::uint32_t vertex : vertices) {
    const aiVector3D difference = to[vertex] - from[vertex];
    values.insert(values.end(), {difference.x, difference.y, difference.z});
  }
  return values;
}

} // namespace

std::set<std::string> boneNames(const aiScene& source) {
  std::set<std::string> names;
  for (unsigned i = 0; i < source.mNumMeshes; ++i)
    for (unsigned b = 0; b < source.mMeshes[i]->mNumBones; ++b)
      names.insert(source.mMeshes[i]->mBones[b]->mName.C_Str());
  return names;
}

bool addBones(const aiMesh& source, std::span<const std::uint32_t> vertices, Mesh& mesh) {
  const std::vector<std::vector<Influence>> influences = influencesOf(source);
  if (influences.empty())
    return false;
  std::size_t largest = 1;
  for (const std::uint32_t vertex : vertices)
    largest = std::max(largest, influences[vertex].size());
  for (std::size_t set = 0; 4 * set < largest; ++set) {
    NamedAttribute joints{jointsName(set), 4, {}}, weights{jointWeightsName(set), 4, {}};
    for (const std::uint32_t vertex : vertices) {
      const std::vector<Influence>& list = influences[vertex];
      float sum = 0;
      for (const Influence& each : list)
        sum += each.weight;
      for (std::size_t i = 4 * set; i < 4 * set + 4; ++i) {
        joints.values.push_back(i < list.size() ? static_cast<float>(list[i].joint) : 0);
        weights.values.push_back(i < list.size() ? list[i].weight / sum : i == 0 ? 1 : 0);
      }
    }
    mesh.namedAttributes.push_back(std::move(joints));
    mesh.namedAttributes.push_back(std::move(weights));
  }
  return true;
}

bool addTargets(const aiMesh& source, std::span<const std::uint32_t> vertices, Mesh& mesh) {
  if (source.mNumAnimMeshes > maxDisplacers)
    return false;
  std::vector<NamedAttribute> added;
  bool haveNormals = !mesh.normals.empty();
  for (unsigned t = 0; t < source.mNumAnimMeshes; ++t)
    haveNormals = haveNormals && source.mAnimMeshes[t]->HasNormals();
  for (unsigned t = 0; t < source.mNumAnimMeshes; ++t) {
    const aiAnimMesh& target = *source.mAnimMeshes[t];
    if (target.mNumVertices != source.mNumVertices || !target.HasPositions())
      return false;
    added.push_back({displacementName(t), 3, differences(source.mVertices, target.mVertices, vertices)});
    if (haveNormals)
      added.push_back({normalDisplacementName(t), 3, differences(source.mNormals, target.mNormals, vertices)});
  }
  for (const NamedAttribute& attribute : added)
    if (!std::ranges::all_of(attribute.values, [](float value) { return std::isfinite(value); }))
      return false;
  std::ranges::move(added, std::back_inserter(mesh.namedAttributes));
  return true;
}

Humanoid humanoidOf(const aiMesh& source, const std::map<std::string, std::size_t>& nodes) {
  Humanoid humanoid;
  for (unsigned b = 0; b < source.mNumBones; ++b) {
    const aiBone& bone = *source.mBones[b];
    const aiMatrix4x4& m = bone.mOffsetMatrix;
    const auto found = nodes.find(bone.mName.C_Str());
    if (found == nodes.end() || !isFiniteMatrix(m))
      return {};
    humanoid.joints.push_back(found->second);
    humanoid.inverseBindings.push_back(mapOf(m));
  }
  return humanoid;
}

} // namespace imgeo
