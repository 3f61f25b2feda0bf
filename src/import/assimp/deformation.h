#pragma once
// Bones and morph targets of Assimp's meshes, as further attributes of meshes (scene/skin.h).

#include "scene/scene.h"

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

struct aiMesh;
struct aiScene;

namespace imgeo {

/// The names of all nodes that are bones of meshes.
std::set<std::string> boneNames(const aiScene& source);

/// Adds the joints of a mesh with bones: of each vertex the eight with the largest weights, whose sum is scaled to one.
/// `vertices`: the source's vertex of each wedge. Returns false, and adds nothing, for weights that are negative or not
/// finite, or of vertices that do not exist.
bool addBones(const aiMesh& source, std::span<const std::uint32_t> vertices, Mesh& mesh);

/// Adds the displacements of the morph targets likewise. Returns false, and adds nothing, for targets with another
/// number of vertices, or too many of them, and for positions that are not finite.
bool addTargets(const aiMesh& source, std::span<const std::uint32_t> vertices, Mesh& mesh);

/// A humanoid with the bones of a mesh; without joints if a bone is no node of the scene, or its matrix not finite.
Humanoid humanoidOf(const aiMesh& source, const std::map<std::string, std::size_t>& nodes);

} // namespace imgeo
