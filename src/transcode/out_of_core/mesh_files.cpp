#include "transcode/out_of_core/mesh_files.h"

#include "base/error.h"
#include "transcode/out_of_core/work_folder.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

// Layout of a file: the meshes; an Index for each of them; attributes, warnings and the error of colours that reading
// them has found; the offset of the first Index, in the last eight bytes.

struct Index {
  std::uint64_t mesh = 0, offset = 0, bytes = 0, elements = 0;
  Box3d box;
};

template <typename T> void addValues(WorkWriter& out, const std::vector<T>& values) {
  out.addAll(std::span<const T>(values));
}

void addMesh(WorkWriter& out, const Mesh& mesh) {
  out.addText(mesh.name);
  out.add(mesh.topology);
  addValues(out, mesh.positions);
  addValues(out, mesh.wedgePositions);
  addValues(out, mesh.corners);
  visitAttributes(mesh, [&](const auto&, const auto& values) { addValues(out, values); });
  out.addTexts(mesh.texCoordMappings);
  out.add(mesh.colorComponents);
  out.add(std::uint64_t{mesh.namedAttributes.size()});
  for (const NamedAttribute& attribute : mesh.namedAttributes) {
    out.addText(attribute.name);
    out.add(attribute.components);
    addValues(out, attribute.values);
  }
}

template <typename T> void takeValues(WorkReader& in, std::vector<T>& values) {
  values = in.takeAll<T>();
}

Mesh takeMesh(WorkReader& in) {
  Mesh mesh;
  mesh.name = in.takeText();
  mesh.topology = in.take<Topology>();
  takeValues(in, mesh.positions);
  takeValues(in, mesh.wedgePositions);
  takeValues(in, mesh.corners);
  visitAttributes(mesh, [&](const auto&, auto& values) { takeValues(in, values); });
  mesh.texCoordMappings = in.takeTexts();
  mesh.colorComponents = in.take<std::uint32_t>();
  for (auto count = in.take<std::uint64_t>(); count > 0; --count) {
    NamedAttribute& attribute = mesh.namedAttributes.emplace_back();
    attribute.name = in.takeText();
    attribute.components = in.take<std::uint32_t>();
    takeValues(in, attribute.values);
  }
  return mesh;
}

} // namespace

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
                const std::function<double(Scene&)>& prepare) {
  Imported imported = source.readScene(batch, options);
  const double colorError = prepare(imported.scene);
  WorkWriter out;
  std::vector<Index> indices;
  for (const std::size_t mesh : batch) {
    const Mesh read = std::move(imported.scene.meshes.at(mesh));
    const std::uint64_t offset = out.bytes.size();
    addMesh(out, read);
    indices.push_back({mesh, offset, out.bytes.size() - offset, read.elementCount(), boxOf(read)});
  }
  const std::uint64_t end = out.bytes.size();
  addValues(out, indices);
  out.addTexts(imported.attributes);
  out.addTexts(imported.warnings);
  out.add(colorError);
  out.add(end);
  return std::move(out.bytes);
}

void MeshFiles::add(const std::filesystem::path& file) {
  auto view = std::make_unique<FileView>(file);
  const ByteSpan bytes = view->bytes();
  std::uint64_t begin = sizeof(begin);
  if (bytes.size() >= begin)
    begin = WorkReader(bytes.last(sizeof(begin)), file).take<std::uint64_t>();
  if (begin > bytes.size())
    throw Error(ErrorKind::malformed, file.string(), "is no file of meshes");
  WorkReader in(bytes.subspan(begin), file);
  for (const Index& index : in.takeAll<Index>()) {
    if (index.offset > begin || index.bytes > begin - index.offset)
      throw Error(ErrorKind::malformed, file.string(), "is no file of meshes");
    meshes_[index.mesh] = {files_.size(), index.offset, index.bytes, index.elements, index.box};
  }
  addMissing(attributes_, in.takeTexts());
  addMissing(warnings_, in.takeTexts());
  colorError_ = std::max(colorError_, in.take<double>());
  paths_.push_back(file);
  files_.push_back(std::move(view));
}

Mesh MeshFiles::read(std::size_t mesh) const {
  const StoredMesh& stored = meshes_.at(mesh);
  WorkReader in(files_[stored.file]->bytes().subspan(stored.offset, stored.bytes), paths_[stored.file]);
  return takeMesh(in);
}

std::vector<std::size_t> MeshFiles::emptyMeshes() const {
  std::vector<std::size_t> empty;
  for (const auto& [mesh, stored] : meshes_)
    if (stored.elements == 0)
      empty.push_back(mesh);
  return empty;
}

} // namespace imgeo
