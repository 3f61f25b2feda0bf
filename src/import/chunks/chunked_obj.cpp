#include "import/chunks/chunked_obj.h"

#include "base/error.h"
#include "import/chunks/index_ranks.h"
#include "import/complete_import.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/far_origin.h"
#include "import/obj/materials.h"
#include "import/obj/object_shapes.h"
#include "import/source_name.h"
#include "import/text/line_ends.h"
#include "import/warnings.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

/// The values at indices of a part of an array; the indices become those of the part.
template <typename T>
std::vector<T> takePart(const ScratchArray<T>& all, std::vector<ObjCorner>& corners,
                        std::uint32_t ObjCorner::*const index) {
  std::vector<std::uint32_t> used;
  for (const ObjCorner& corner : corners)
    if (corner.*index != ObjCorner::none)
      used.push_back(corner.*index);
  const IndexRanks ranks(std::move(used));
  for (ObjCorner& corner : corners)
    if (corner.*index != ObjCorner::none)
      corner.*index = ranks.of(corner.*index);
  std::vector<T> part;
  for (const std::uint32_t i : ranks.indices())
    part.push_back(all[i]);
  return part;
}

} // namespace

ChunkedObj::ChunkedObj(SourceContent content, const std::filesystem::path& scratch, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content)), positions_(nearestFolder(scratch)), normals_(nearestFolder(scratch)),
      texCoords_(nearestFolder(scratch)), colors_(nearestFolder(scratch)),
      triangles_(std::make_unique<Triangles>(nearestFolder(scratch))), subsetOf_(nearestFolder(scratch)) {
  requireLineFeeds(bytes(), name_);
  ObjStatements statements(bytes(), name_, std::nullopt, *this);
  statements.read();
  positions_.shrink(), normals_.shrink(), texCoords_.shrink(), colors_.shrink(), triangles_->shrink();
  libraries_ = statements.libraries();
  origin_ = statements.origin();
  statements.addWarnings(warnings_, !subsets_.empty());
  if (subsets_.size() > 1)
    sortTriangles(statements.objects(), nearestFolder(scratch));
  removeMeshes();
  for (const Subset& subset : subsets_) {
    beginMesh(Topology::triangles);
    addPieces(subset.first, subset.count, chunkRecords);
  }
  if (subsets_.empty()) {
    beginMesh(Topology::points);
    addPieces(0, positions_.size(), chunkRecords);
  }
}

void ChunkedObj::addPieces(std::uint64_t first, std::uint64_t count, std::uint64_t chunkRecords) {
  for (const std::uint64_t end = first + count; first < end; first += chunkRecords) {
    const std::uint64_t records = std::min(chunkRecords, end - first);
    add({static_cast<std::size_t>(first), static_cast<std::size_t>(first + records), records, records});
  }
}

void ChunkedObj::sortTriangles(std::span<const ObjObject> objects, const std::filesystem::path& scratch) {
  std::vector<Subset> sorted;
  std::vector<std::size_t> numberOf(subsets_.size());
  std::uint64_t first = 0;
  for (const ObjObject& object : objects)
    if (const auto found = subsetNumbers_.find({object.index, object.material}); found != subsetNumbers_.end()) {
      numberOf[found->second] = sorted.size();
      sorted.push_back(std::move(subsets_[found->second]));
      sorted.back().first = std::exchange(first, first + sorted.back().count);
    }
  std::vector<std::uint64_t> next;
  for (const Subset& subset : sorted)
    next.push_back(subset.first);
  auto triangles = std::make_unique<Triangles>(scratch);
  triangles->resize(triangles_->size());
  for (std::size_t i = 0; i < triangles_->size(); ++i)
    (*triangles)[next[numberOf[subsetOf_[i]]]++] = (*triangles_)[i];
  triangles_ = std::move(triangles);
  subsetOf_.resize(0);
  subsets_ = std::move(sorted);
}

void ChunkedObj::requireFewer(std::size_t count, const char* what) const {
  if (count >= ObjCorner::none)
    throw Error(ErrorKind::limit, name_, fmt::format("has more {} than 32-bit indices can name", what));
}

void ChunkedObj::addVertex(const Vec3f& position, const Rgba* color) {
  requireFewer(positions_.size(), "vertices");
  while (color && colors_.size() < positions_.size())
    colors_.append(Rgba(1, 1, 1, 1)); // for earlier vertices without colours
  if (color)
    colors_.append(*color);
  positions_.append(position);
}

void ChunkedObj::addTexCoord(const Vec2f& texCoord) {
  requireFewer(texCoords_.size(), "texture coordinates");
  texCoords_.append(texCoord);
}

void ChunkedObj::addNormal(const Vec3f& normal) {
  requireFewer(normals_.size(), "normals");
  normals_.append(normal);
}

void ChunkedObj::expectVertices() {
  throw Error(ErrorKind::unsupported, name_, "has polygons before their vertices, and is not read piece by piece");
}

void ChunkedObj::addTriangle(ObjObject& object, const std::array<ObjCorner, 3>& corners) {
  if (subsets_.empty() || object.index != subsets_[current_].object.index ||
      object.material != subsets_[current_].object.material)
    beginSubset(object);
  Subset& subset = subsets_[current_];
  for (const ObjCorner& corner : corners) {
    subset.hasTexCoords |= corner.texCoord != ObjCorner::none;
    subset.hasNormals &= corner.normal != ObjCorner::none;
    subset.hasSomeNormals |= corner.normal != ObjCorner::none;
  }
  ++subset.count;
  triangles_->append(corners);
  if (subsets_.size() > 1)
    subsetOf_.append(static_cast<std::uint32_t>(current_));
}

/// Begins with the triangles of a subset, or goes on with them.
void ChunkedObj::beginSubset(const ObjObject& object) {
  const auto [subset, isNew] = subsetNumbers_.try_emplace({object.index, object.material}, subsets_.size());
  current_ = subset->second;
  if (!isNew)
    return;
  subsets_.push_back({.object = {object.name, object.material, object.index, {}, {}}});
  if (subsets_.size() == 2)
    for (std::size_t i = 0; i < triangles_->size(); ++i)
      subsetOf_.append(0);
}

void ChunkedObj::addLine(ObjObject&, const std::array<ObjCorner, 2>&) {
  throw Error(ErrorKind::unsupported, name_, "has lines, and is not read piece by piece");
}

Mesh ChunkedObj::trianglesOf(const Subset& subset, std::uint64_t first, std::uint64_t count) const {
  ObjContent content;
  ObjObject object;
  for (std::uint64_t i = first; i < first + count; ++i)
    for (ObjCorner corner : (*triangles_)[i]) {
      if (!subset.hasNormals)
        corner.normal = ObjCorner::none;
      object.triangles.push_back(corner);
    }
  std::vector<ObjCorner> byPosition = object.triangles; // whose colours are numbered as positions are
  if (colors_.size() > 0)
    content.colors = takePart(colors_, byPosition, &ObjCorner::position);
  byPosition = {};
  content.positions = takePart(positions_, object.triangles, &ObjCorner::position);
  content.texCoords = takePart(texCoords_, object.triangles, &ObjCorner::texCoord);
  content.normals = takePart(normals_, object.triangles, &ObjCorner::normal);
  Mesh mesh = ObjMeshBuilder(content).build(object, Topology::triangles);
  if (subset.hasTexCoords && mesh.texCoords.empty()) // those that other pieces have
    mesh.texCoords.resize(mesh.wedgeCount());
  return mesh;
}

Mesh ChunkedObj::pointsOf(std::uint64_t first, std::uint64_t count) const {
  Mesh mesh;
  mesh.topology = Topology::points;
  for (std::uint64_t i = first; i < first + count; ++i) {
    mesh.corners.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(positions_[i]);
    if (colors_.size() > 0)
      mesh.colors.push_back(colors_[i]);
  }
  mesh.wedgePositions = mesh.corners;
  mesh.name = stemOf(name_);
  return mesh;
}

Imported ChunkedObj::readScene(const std::set<std::size_t>& whole, const ImportOptions& given) const {
  const ImportOptions options = besideFile(given);
  const References references(options, name_);
  Imported imported;
  imported.format = "OBJ";
  if (subsets_.empty()) {
    addShape(imported.scene,
             pointsOf(0, whole.contains(0) ? positions_.size() : std::min<std::size_t>(positions_.size(), 1)), "");
  } else {
    ObjMaterials materials(imported.scene.graph, references);
    for (const std::string& library : libraries_)
      materials.readLibrary(library);
    std::vector<ObjObject> objects;
    for (const Subset& subset : subsets_)
      objects.push_back(subset.object);
    const ObjMeshSource meshOf = [&](const ObjObject&, Topology topology) -> std::optional<Mesh> {
      const std::size_t mesh = imported.scene.meshes.size();
      if (topology != Topology::triangles)
        return std::nullopt;
      return trianglesOf(subsets_[mesh], subsets_[mesh].first, whole.contains(mesh) ? subsets_[mesh].count : 1);
    };
    addObjectShapes(imported.scene, objects, meshOf, materials, name_);
    warnOfPartialNormals(imported.warnings,
                         static_cast<std::size_t>(std::ranges::count_if(subsets_, [](const Subset& subset) {
                           return subset.hasSomeNormals && !subset.hasNormals;
                         })));
    addOmissions(imported.warnings, materials.omissions(), options.strict, name_);
    materials.addWarnings(imported.warnings);
  }
  setOrigin(imported, origin_);
  std::ranges::copy(warnings_, std::back_inserter(imported.warnings));
  completeImport(imported, false, options, name_);
  return imported;
}

Imported ChunkedObj::readChunk(const Chunk& chunk, const ImportOptions&) const {
  Imported imported;
  imported.format = "OBJ";
  addShape(imported.scene,
           subsets_.empty() ? pointsOf(chunk.offset, chunk.records)
                            : trianglesOf(subsets_[chunk.mesh], chunk.offset, chunk.records),
           "");
  return imported;
}

} // namespace imgeo
