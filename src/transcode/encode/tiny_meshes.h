#pragma once
// Encodes meshes of a few triangles into files whose patches share one geometry node: docs/decisions/tiny-shapes.md.

#include "documents/documents.h"
#include "scene/stored_meshes.h"
#include "transcode/encode/encode_mesh.h"
#include "transcode/encode/patch_files.h"

#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace imgeo {

/// Scenes of fewer meshes state a box for each.
inline constexpr std::size_t minTinyMeshScene = 2000;

/// Whether a mesh may share its geometry node with others.
bool isTiny(const Mesh& mesh, const ConvertOptions& options);

/// For each node the nearest Transform above it, plus 1; 0: none. Shapes below the same one share coordinates. Of a
/// USEd node the first instance counts.
std::vector<std::size_t> transformsAbove(const SceneGraph& graph);

/// Distributes meshes over files in the order of add(). All patches of a file are on one lattice, whose step is at most
/// that of each mesh alone, and have the file's box. Meshes share a file where that box says about as much about the
/// position of each as its own box would.
class TinyMeshes {
public:
  /// Everything must outlive this. Geometries are added to `document`. `stored`: meshes that are on the disk.
  TinyMeshes(SceneDocument& document, const ConvertOptions& options, ContentFiles& files, PatchFiles& patchFiles,
             ConvertReport& report, const ElementsDone& done, const StoredMeshes* stored)
      : document_(document), options_(options), files_(files), patchFiles_(patchFiles), report_(report), done_(done),
        stored_(stored) {}

  /// Takes the mesh of a geometry. `group`: see loadGroups. `transform`: see transformsAbove. `storedMesh`: its number
  /// on the disk, where it is read again rather than kept until its file is full.
  void add(Mesh mesh, std::size_t geometryIndex, std::size_t group, std::size_t transform,
           std::optional<std::size_t> storedMesh);

  /// Encodes the remaining meshes. To be called once, at the end.
  void finish();

private:
  struct Member {
    Mesh mesh; ///< empty where it is stored
    std::optional<std::size_t> storedMesh;
    std::size_t geometryIndex = 0;
    std::size_t group = 0; ///< see loadGroups
    std::size_t order = 0; ///< number of earlier calls of add()
  };
  /// What the meshes of a file have in common: group, transform, exponent of their extent, vertices, corners, boxes of
  /// texture coordinates.
  using Key = std::tuple<std::size_t, std::size_t, int, std::size_t, std::size_t, std::vector<float>>;
  struct File {
    std::vector<Member> members;
    Box3d box;
    double step = 0; ///< the minimum of those of the members' own lattices
    std::size_t vertices = 0;
  };

  void encode(File file);
  Mesh takeMesh(Member& member) const;
  void take(EncodedMesh encoded, std::size_t geometryIndex, std::size_t group);

  SceneDocument& document_;
  const ConvertOptions& options_;
  ContentFiles& files_;
  PatchFiles& patchFiles_;
  ConvertReport& report_;
  const ElementsDone& done_;
  const StoredMeshes* stored_;
  std::map<Key, File> open_;
  std::vector<Member> alone_; ///< members of files that have too few
  std::size_t addedCount_ = 0;
  std::size_t nextFile_ = 0;
};

} // namespace imgeo
