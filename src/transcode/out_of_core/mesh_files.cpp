#include "transcode/out_of_core/mesh_files.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace imgeo {

void addMissing(std::vector<std::string>& texts, const std::vector<std::string>& further) {
  for (const std::string& text : further)
    if (std::ranges::find(texts, text) == texts.end())
      texts.push_back(text);
}

std::vector<std::set<std::size_t>> batchesOf(const ChunkedSource& source, const std::set<std::size_t>& meshes,
                                             std::uint64_t elements) {
  std::vector<std::set<std::size_t>> batches;
  std::uint64_t sum = 0;
  for (const std::size_t mesh : meshes) {
    const std::uint64_t its = source.mesh(mesh).elementCount();
    if (batches.empty() || sum + its > elements) {
      batches.emplace_back();
      sum = 0;
    }
    batches.back().insert(batches.back().end(), mesh);
    sum += its;
  }
  return batches;
}

std::string fileOfBatch(const std::set<std::size_t>& batch) {
  return fmt::format("meshes-{}-{}", *batch.begin(), *batch.rbegin());
}

Bytes readBatch(const ChunkedSource& source, const std::set<std::size_t>& batch, const ImportOptions& options,
                const std::function<PreparationReport(Scene&)>& prepare) {
  Imported imported = source.readMeshes(batch, options);
  imported.scene.graph.isComplete = true; // whether there is anything to show, the whole scene says
  const PreparationReport prepared = prepare(imported.scene);
  MeshFileWriter file;
  std::size_t position = 0;
  for (const std::size_t mesh : batch)
    file.add(mesh, std::exchange(imported.scene.meshes.at(position++), {}));
  return file.finish(
      {std::move(imported.attributes), std::move(imported.warnings), prepared.colorError, prepared.edges});
}

void MeshFiles::add(const std::filesystem::path& path) {
  auto view = std::make_unique<FileView>(path);
  MeshFile file(view->bytes(), path);
  for (const MeshFileEntry& entry : file.entries()) {
    if (!meshes_.empty() && entry.mesh <= meshes_.back().entry.mesh)
      throw Error(ErrorKind::malformed, path.string(), "has meshes in another order");
    meshes_.push_back({files_.size(), entry});
  }
  addMissing(attributes_, file.findings().attributes);
  addMissing(warnings_, file.findings().warnings);
  colorError_ = std::max(colorError_, file.findings().colorError);
  edges_ += file.findings().edges;
  file.dropEntries();
  files_.push_back({std::move(view), std::move(file)});
}

const MeshFiles::StoredMesh* MeshFiles::find(std::size_t mesh) const {
  const auto found =
      std::ranges::lower_bound(meshes_, mesh, {}, [](const StoredMesh& each) { return each.entry.mesh; });
  return found != meshes_.end() && found->entry.mesh == mesh ? &*found : nullptr;
}

Mesh MeshFiles::read(std::size_t mesh) const {
  const StoredMesh& stored = *find(mesh);
  return files_[stored.file].content.read(stored.entry);
}

std::vector<std::size_t> MeshFiles::emptyMeshes() const {
  std::vector<std::size_t> empty;
  for (const StoredMesh& stored : meshes_)
    if (stored.entry.elements == 0)
      empty.push_back(stored.entry.mesh);
  return empty;
}

} // namespace imgeo
