#pragma once
// Meshes of a scene that are not all in memory.

#include "scene/mesh.h"

#include <memory>
#include <utility>

namespace imgeo {

/// Meshes on the disk, by their number in the scene. In the scene's own list a placeholder stands for each: one of
/// its elements, with all attributes that the mesh has.
class StoredMeshes {
public:
  virtual ~StoredMeshes() = default;
  virtual bool has(std::size_t mesh) const = 0;
  /// The counts and the box of a mesh that is stored.
  virtual std::size_t elementCount(std::size_t mesh) const = 0;
  virtual Box3d box(std::size_t mesh) const = 0;
  /// A mesh that is stored. Safe to call from any thread. Throws Error{malformed} for a damaged file.
  virtual Mesh read(std::size_t mesh) const = 0;
};

/// A mesh that is in memory at least as long as this.
class MeshHandle {
public:
  explicit MeshHandle(const Mesh& mesh) : mesh_(&mesh) {}
  explicit MeshHandle(Mesh&& read) : read_(std::make_unique<Mesh>(std::move(read))), mesh_(read_.get()) {}
  const Mesh& operator*() const { return *mesh_; }
  const Mesh* operator->() const { return mesh_; }

private:
  std::unique_ptr<Mesh> read_;
  const Mesh* mesh_;
};

/// All meshes of a scene, each read from the disk where it is stored there. Everything must outlive this.
class SceneMeshes {
public:
  SceneMeshes(const std::vector<Mesh>& meshes, const StoredMeshes* stored = nullptr)
      : meshes_(&meshes), stored_(stored) {}

  std::size_t size() const { return meshes_->size(); }
  MeshHandle operator[](std::size_t mesh) const {
    return isStored(mesh) ? MeshHandle(stored_->read(mesh)) : MeshHandle((*meshes_)[mesh]);
  }
  /// The mesh, or one element of it where it is stored.
  const Mesh& partOf(std::size_t mesh) const { return (*meshes_)[mesh]; }
  std::size_t elementCount(std::size_t mesh) const {
    return isStored(mesh) ? stored_->elementCount(mesh) : partOf(mesh).elementCount();
  }
  Box3d box(std::size_t mesh) const { return isStored(mesh) ? stored_->box(mesh) : boxOf(partOf(mesh)); }
  bool isStored(std::size_t mesh) const { return stored_ && stored_->has(mesh); }

private:
  const std::vector<Mesh>* meshes_;
  const StoredMeshes* stored_;
};

} // namespace imgeo
