#include "import/assimp/scene_reader.h"

#include "base/error.h"
#include "import/assimp/animations.h"
#include "import/assimp/cameras_and_lights.h"
#include "import/assimp/conversions.h"
#include "import/assimp/deformation.h"
#include "import/assimp/materials.h"
#include "import/assimp/meshes.h"
#include "import/text/rounded_decimal.h"
#include "import/warnings.h"

#include <algorithm>
#include <array>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <set>
#include <vector>

namespace imgeo {

namespace {

constexpr std::size_t maxNodeDepth = 200;

bool isFinite(const Affine3d& map) {
  return std::ranges::all_of(std::array{map.x, map.y, map.z, map.translation},
                             [](Vec3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); });
}

/// Reads one aiScene.
class SceneReader {
public:
  SceneReader(const aiScene& source, const std::string& name, const References& references,
              const ImportOptions& options, std::string_view extension)
      : source_(source), name_(name), isStrict_(options.strict), materials_(source, graph(), references, extension),
        meshes_(name, options.attributes, extension == "fbx", imported_.scene, materials_),
        camerasAndLights_(source, graph()) {}

  Imported read() {
    joints_ = boneNames(source_);
    for (unsigned i = 0; i < source_.mNumMeshes; ++i)
      addDisplacers(source_.mMeshes[i]->mName, meshes_.add(*source_.mMeshes[i]));
    for (unsigned i = 0; i < source_.mNumAnimations; ++i)
      for (unsigned c = 0; c < source_.mAnimations[i]->mNumChannels; ++c)
        moved_.insert(source_.mAnimations[i]->mChannels[c]->mNodeName.C_Str());
    if (source_.mRootNode)
      readRoot(*source_.mRootNode);
    addHumanoids();
    readAnimations();
    addWarnings();
    return std::move(imported_);
  }

private:
  SceneGraph& graph() { return imported_.scene.graph; }

  /// Adds the root node, or its children where Assimp has generated the root.
  void readRoot(const aiNode& root) {
    const std::size_t node = readNode(root, 1);
    const Node& read = graph().nodes[node];
    const bool isGenerated = std::holds_alternative<Group>(read.content) && (read.name.empty() || root.mNumMeshes == 0);
    graph().roots = isGenerated ? read.children : std::vector{node};
  }

  std::size_t readNode(const aiNode& source, std::size_t depth) {
    if (depth > maxNodeDepth)
      throw Error(ErrorKind::limit, name_, "its nodes are nested too deeply");
    Node node;
    node.name = nameOf(source.mName);
    const Affine3d map = mapOf(source.mTransformation);
    const bool isJoint = joints_.contains(source.mName.C_Str());
    const bool isMoved = isJoint || moved_.contains(source.mName.C_Str());
    if (!isFinite(map))
      ++lostTransforms_;
    else if (isMoved)
      node.content = rounded(unskewedTransformOf(map));
    else if (map != Affine3d{})
      node.content = rounded(transformOf(map));
    if (isJoint) {
      if (!std::holds_alternative<Transform>(node.content))
        node.content = Transform{};
      std::get<Transform>(node.content).isJoint = true;
    }
    for (unsigned i = 0; i < source.mNumMeshes; ++i)
      if (const AssimpMeshes::Nodes& mesh = meshes_.at(source.mMeshes[i]); mesh.isSkinned)
        skinned_.insert(source.mMeshes[i]);
      else
        std::ranges::copy(mesh.shapes, std::back_inserter(node.children));
    for (unsigned i = 0; i < source.mNumMeshes; ++i)
      addDisplacers(source.mName, meshes_.at(source.mMeshes[i]));
    camerasAndLights_.addTo(source, node);
    for (unsigned i = 0; i < source.mNumChildren; ++i)
      node.children.push_back(readNode(*source.mChildren[i], depth + 1));
    const bool isTransform = std::holds_alternative<Transform>(node.content);
    const std::size_t index = addNode(graph(), std::move(node));
    if (isMoved && isTransform)
      movedNodes_.emplace(source.mName.C_Str(), index);
    return index;
  }

  /// Lets animations refer to the displacers of a mesh by `name`.
  void addDisplacers(const aiString& name, const AssimpMeshes::Nodes& mesh) {
    if (!mesh.displacers.empty())
      displacers_[name.C_Str()].insert(mesh.displacers);
  }

  /// Adds a humanoid for each mesh with bones, behind all joints. As in glTF the transform of its node does not count.
  void addHumanoids() {
    for (const unsigned mesh : skinned_) {
      Humanoid humanoid = humanoidOf(*source_.mMeshes[mesh], movedNodes_);
      if (humanoid.joints.empty()) {
        ++lostSkins_;
        std::ranges::copy(meshes_.at(mesh).shapes, std::back_inserter(graph().roots));
        continue;
      }
      addRoot(graph(), {nameOf(source_.mMeshes[mesh]->mName), std::move(humanoid), meshes_.at(mesh).shapes, ""});
    }
  }

  void readAnimations() {
    AssimpAnimations animations(source_, graph(), movedNodes_, displacers_);
    animations.read();
    otherChannels_ = animations.otherChannels;
    malformedChannels_ = animations.malformedChannels;
  }

  void addWarnings() {
    std::vector<std::string>& warnings = imported_.warnings;
    const auto add = [&](std::size_t count, const char* singular, const char* plural) {
      if (count > 0)
        warnings.push_back(fmt::format("{} not carried over.", counted(count, singular, plural)));
    };
    add(otherChannels_, "animation of morph targets that no mesh has, or of a whole mesh, is",
        "animations of morph targets that no mesh has, or of whole meshes, are");
    add(malformedChannels_, "animation of a node, whose keys are not in order or not finite, is",
        "animations of nodes, whose keys are not in order or not finite, are");
    add(meshes_.damagedSkins + lostSkins_, "skin with damaged weights, or bones that are not in the scene, is",
        "skins with damaged weights, or bones that are not in the scene, are");
    add(meshes_.damagedTargets, "mesh has damaged or too many morph targets, which are",
        "meshes have damaged or too many morph targets, which are");
    if (meshes_.unknownWeights > 0)
      warnings.push_back(fmt::format("The weights at rest of {} are 0: Assimp does not report those of FBX files.",
                                     counted(meshes_.unknownWeights, "morph target", "morph targets")));
    add(meshes_.furtherTexCoords, "mesh has texture coordinates that no texture uses, which are",
        "meshes have texture coordinates that no texture uses, which are");
    add(meshes_.furtherColors, "mesh has further colours, which are", "meshes have further colours, which are");
    add(camerasAndLights_.otherLights, "light of a kind that X3D lacks is", "lights of kinds that X3D lacks are");
    add(lostTransforms_, "transform that is not finite is", "transforms that are not finite are");
    warnOfNormals(warnings, meshes_.unusableNormals);
    warnOfFans(warnings, meshes_.fans);
    addOmissions(warnings, materials_.omissions(), isStrict_, name_);
    materials_.addWarnings(warnings);
  }

  const aiScene& source_;
  const std::string& name_;
  bool isStrict_;
  Imported imported_;
  AssimpMaterials materials_;
  AssimpMeshes meshes_;
  AssimpCamerasAndLights camerasAndLights_;
  std::set<std::string> moved_; ///< names of the nodes that animations move
  std::map<std::string, std::size_t> movedNodes_;
  DisplacersByName displacers_;
  std::size_t otherChannels_ = 0, malformedChannels_ = 0;
  std::set<std::string> joints_; ///< names of the nodes that are bones
  std::set<unsigned> skinned_;   ///< meshes of nodes, with bones
  std::size_t lostSkins_ = 0;    ///< with bones that are not in the scene
  std::size_t lostTransforms_ = 0;
};

} // namespace

Imported readAssimpScene(const aiScene& source, const std::string& name, const References& references,
                         const ImportOptions& options, std::string_view extension) {
  return SceneReader(source, name, references, options, extension).read();
}

} // namespace imgeo
