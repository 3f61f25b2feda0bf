#include "transcode/out_of_core/mesh_file.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace imgeo {

namespace {

// Layout of a file: the meshes; an entry for each of them; findings; the offset of the first entry, in the last eight
// bytes.

template <typename T> void addValues(WorkWriter& out, const std::vector<T>& values) {
  out.addAll(std::span<const T>(values));
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

bool isFinite(const Vec3f& position) {
  return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
}

/// Whether a mesh is one of a scene, and what its entry says.
bool isOf(const MeshFileEntry& entry, const Mesh& mesh) {
  return std::ranges::find(allTopologies, mesh.topology) != std::end(allTopologies) && isConsistent(mesh) &&
         (mesh.colorComponents == 3 || mesh.colorComponents == 4) && mesh.elementCount() == entry.elements &&
         std::ranges::all_of(mesh.positions, isFinite) && boxOf(mesh) == entry.box;
}

} // namespace

void MeshFileWriter::add(std::size_t number, const Mesh& mesh) {
  const std::uint64_t offset = out_.bytes.size();
  out_.addText(mesh.name);
  out_.add(mesh.topology);
  addValues(out_, mesh.positions);
  addValues(out_, mesh.wedgePositions);
  addValues(out_, mesh.corners);
  visitAttributes(mesh, [&](const auto&, const auto& values) { addValues(out_, values); });
  out_.addTexts(mesh.texCoordMappings);
  out_.add(mesh.colorComponents);
  out_.add(std::uint64_t{mesh.namedAttributes.size()});
  for (const NamedAttribute& attribute : mesh.namedAttributes) {
    out_.addText(attribute.name);
    out_.add(attribute.components);
    addValues(out_, attribute.values);
  }
  entries_.push_back({number, offset, out_.bytes.size() - offset, mesh.elementCount(), boxOf(mesh)});
}

Bytes MeshFileWriter::finish(const MeshFileFindings& findings) {
  const std::uint64_t end = out_.bytes.size();
  addValues(out_, entries_);
  out_.addTexts(findings.attributes);
  out_.addTexts(findings.warnings);
  out_.add(findings.colorError);
  for (const std::size_t meshes : {findings.edges.guessedSharp, findings.edges.guessedSmooth, findings.edges.flat})
    out_.add(std::uint64_t{meshes});
  out_.add(end);
  return std::move(out_.bytes);
}

MeshFile::MeshFile(ByteSpan bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {
  std::uint64_t begin = sizeof(begin);
  if (bytes.size() >= begin)
    begin = WorkReader(bytes.last(sizeof(begin)), path_).take<std::uint64_t>();
  if (begin > bytes.size())
    fail();
  WorkReader in(bytes.subspan(begin), path_);
  entries_ = in.takeAll<MeshFileEntry>();
  for (const MeshFileEntry& entry : entries_)
    if (entry.offset > begin || entry.bytes > begin - entry.offset)
      fail();
  findings_.attributes = in.takeTexts();
  findings_.warnings = in.takeTexts();
  findings_.colorError = in.take<double>();
  for (std::size_t* meshes : {&findings_.edges.guessedSharp, &findings_.edges.guessedSmooth, &findings_.edges.flat})
    *meshes = in.take<std::uint64_t>();
}

void MeshFile::fail() const {
  throw Error(ErrorKind::malformed, path_, "is no work file of this conversion; convert without --resume");
}

Mesh MeshFile::read(const MeshFileEntry& entry) const {
  WorkReader in(bytes_.subspan(entry.offset, entry.bytes), path_);
  Mesh mesh = takeMesh(in);
  if (!isOf(entry, mesh))
    fail();
  return mesh;
}

} // namespace imgeo
