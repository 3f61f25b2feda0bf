#include "import/chunks/chunked_obj.h"

#include "base/error.h"
#include "import/chunks/index_ranks.h"
#include "import/obj/materials.h"
#include "import/source_name.h"
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
      texCoords_(nearestFolder(scratch)), colors_(nearestFolder(scratch)), triangles_(nearestFolder(scratch)) {
  ObjStatements statements(bytes(), name_, *this);
  statements.read();
  positions_.shrink(), normals_.shrink(), texCoords_.shrink(), colors_.shrink(), triangles_.shrink();
  libraries_ = statements.libraries();
  const bool hasFaces = triangles_.size() > 0;
  statements.addWarnings(warnings_, hasFaces);
  setTopology(hasFaces ? Topology::triangles : Topology::points);
  const std::uint64_t count = hasFaces ? triangles_.size() : positions_.size();
  for (std::uint64_t first = 0; first < count; first += chunkRecords) {
    const std::uint64_t records = std::min(chunkRecords, count - first);
    add({static_cast<std::size_t>(first), static_cast<std::size_t>(first + records), records, records});
  }
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

void ChunkedObj::addTriangle(ObjObject& object, const std::array<ObjCorner, 3>& corners) {
  if (!objectIndex_) {
    objectIndex_ = object.index, object_ = object.name, material_ = object.material;
  } else if (object.index != *objectIndex_ || object.material != material_) {
    throw Error(ErrorKind::unsupported, name_,
                fmt::format("has several {}, each of which is a shape, and is not read piece by piece",
                            object.index != *objectIndex_ ? "objects" : "materials"));
  }
  for (const ObjCorner& corner : corners) {
    hasTexCoords_ |= corner.texCoord != ObjCorner::none;
    hasNormals_ &= corner.normal != ObjCorner::none;
    hasSomeNormals_ |= corner.normal != ObjCorner::none;
  }
  triangles_.append(corners);
}

void ChunkedObj::addLine(ObjObject&, const std::array<ObjCorner, 2>&) {
  throw Error(ErrorKind::unsupported, name_, "has lines, and is not read piece by piece");
}

Mesh ChunkedObj::trianglesOf(const Chunk& chunk) const {
  ObjContent content;
  ObjObject& object = content.objects.emplace_back();
  for (std::size_t i = chunk.offset; i < chunk.end; ++i)
    for (ObjCorner corner : triangles_[i]) {
      if (!hasNormals_)
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
  if (hasTexCoords_ && mesh.texCoords.empty()) // those that other pieces have
    mesh.texCoords.resize(mesh.wedgeCount());
  return mesh;
}

Mesh ChunkedObj::pointsOf(const Chunk& chunk) const {
  Mesh mesh;
  mesh.topology = Topology::points;
  for (std::size_t i = chunk.offset; i < chunk.end; ++i) {
    mesh.corners.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(positions_[i]);
    if (colors_.size() > 0)
      mesh.colors.push_back(colors_[i]);
  }
  mesh.wedgePositions = mesh.corners;
  return mesh;
}

void ChunkedObj::describe(Imported& imported, const ImportOptions& given) const {
  ImportOptions options = given;
  const std::filesystem::path path = name_;
  options.folder = path.has_parent_path() ? path.parent_path() : ".";
  const References references(options, name_);
  ObjMaterials materials(imported.scene.graph, references);
  if (objectIndex_) {
    if (hasSomeNormals_ && !hasNormals_)
      imported.warnings.push_back("The normals of 1 object were left out: some corners have none.");
    for (const std::string& library : libraries_)
      materials.readLibrary(library);
    if (!material_.empty())
      std::get<Shape>(imported.scene.graph.nodes[imported.scene.graph.roots[0]].content).appearance =
          materials.appearance(material_);
    addOmissions(imported.warnings, materials.omissions(), options.strict, name_);
    materials.addWarnings(imported.warnings);
  }
  std::ranges::copy(warnings_, std::back_inserter(imported.warnings));
}

Imported ChunkedObj::readChunk(const Chunk& chunk, const ImportOptions& options) const {
  Mesh mesh = objectIndex_ ? trianglesOf(chunk) : pointsOf(chunk);
  mesh.name = object_.empty() ? stemOf(name_) : object_;
  Imported imported;
  imported.format = "OBJ";
  imported.scene.meshes.push_back(std::move(mesh));
  addRoot(imported.scene.graph, {object_, Shape{}, {}, ""});
  if (chunk.number == 0)
    describe(imported, options);
  return imported;
}

} // namespace imgeo
