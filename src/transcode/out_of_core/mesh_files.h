#pragma once
// Meshes that memory holds one by one and not together: they are read and prepared in batches, and are in work files
// from then on, one for each batch.

#include "base/file_view.h"
#include "import/chunks/chunked_source.h"
#include "scene/stored_meshes.h"
#include "transcode/out_of_core/mesh_file.h"
#include "transcode/source/preparation.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace imgeo {

/// Divides meshes of a source, in their order, into batches of at most so many triangles and points, or of one mesh.
std::vector<std::set<std::size_t>> batchesOf(const ChunkedSource& source, const std::set<std::size_t>& meshes,
                                             std::uint64_t elements);

/// The name of the work file of a batch.
std::string fileOfBatch(const std::set<std::size_t>& batch);

/// Reads a batch and returns the content of its work file. `prepare` prepares its meshes. Throws Error for the source.
Bytes readBatch(const ChunkedSource& source, const std::set<std::size_t>& batch, const ImportOptions& options,
                const std::function<PreparationReport(Scene&)>& prepare);

class MeshFiles : public StoredMeshes {
public:
  /// Adds the meshes of a work file, whose numbers are above those of earlier ones. Throws Error{io, malformed}.
  void add(const std::filesystem::path& file);

  bool has(std::size_t mesh) const override { return find(mesh) != nullptr; }
  std::size_t elementCount(std::size_t mesh) const override { return find(mesh)->entry.elements; }
  Box3d box(std::size_t mesh) const override { return find(mesh)->entry.box; }
  Mesh read(std::size_t mesh) const override;

  /// What was found when the batches were read.
  const std::vector<std::string>& attributes() const { return attributes_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  double colorError() const { return colorError_; }
  const EdgeReport& edges() const { return edges_; }
  /// Meshes that were found to have no elements when all of them were read.
  std::vector<std::size_t> emptyMeshes() const;

private:
  struct StoredMesh {
    std::size_t file = 0; ///< index into `files_`
    MeshFileEntry entry;
  };
  const StoredMesh* find(std::size_t mesh) const;

  struct File {
    std::unique_ptr<FileView> view;
    MeshFile content;
  };
  std::vector<File> files_;
  std::vector<StoredMesh> meshes_; ///< by number
  std::vector<std::string> attributes_, warnings_;
  double colorError_ = 0;
  EdgeReport edges_;
};

/// Appends those texts to `texts` that are not among them.
void addMissing(std::vector<std::string>& texts, const std::vector<std::string>& further);

} // namespace imgeo
