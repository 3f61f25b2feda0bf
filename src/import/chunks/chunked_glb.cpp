#include "import/chunks/chunked_glb.h"

#include "base/error.h"
#include "import/chunks/index_ranks.h"
#include "import/complete_import.h"
#include "import/gltf/materials.h"
#include "import/gltf/primitive.h"
#include "import/gltf/read_document.h"
#include "import/text/text_scanner.h"
#include "import/warnings.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace imgeo {

namespace {

using namespace gltf;

// Modes and component types, as the specification numbers them.
constexpr std::uint64_t pointsMode = 0, trianglesMode = 4;
constexpr int unsignedInt = 5125;

constexpr std::size_t first = 0;

ImportOptions beside(const ImportOptions& given, const std::filesystem::path& path) {
  ImportOptions options = given;
  options.folder = path.has_parent_path() ? path.parent_path() : ".";
  return options;
}

} // namespace

ChunkedGlb::ChunkedGlb(SourceContent content, std::uint64_t chunkRecords) : ChunkedSource(std::move(content)) {
  const GlbChunks chunks = chunksOf(bytes(), name_);
  json_ = parseJson(chunks.json, name_);
  binary_ = chunks.binary;
  const References references({}, name_);
  Document document(json_, binary_, references, name_, bytes().size());
  checkSupported(document.root());
  const Value primitive = primitiveOf(document.root());
  readArrays(document, primitive);
  const std::uint64_t mode = primitive["mode"].whole(trianglesMode);
  if (mode != trianglesMode && mode != pointsMode)
    refuse("has lines, strips or fans");
  topology_ = mode == pointsMode ? Topology::points : Topology::triangles;
  const std::uint64_t count = (indices_ ? indices_->accessor.count() : vertexCount_) / cornersPerElement(topology_);
  for (std::uint64_t begin = 0; begin < count; begin += chunkRecords) {
    const std::uint64_t records = std::min(chunkRecords, count - begin);
    add({static_cast<std::size_t>(begin), static_cast<std::size_t>(begin + records), records, records});
  }
}

void ChunkedGlb::refuse(const char* reason) const {
  throw Error(ErrorKind::unsupported, name_, fmt::format("{}, and is not read piece by piece", reason));
}

Value ChunkedGlb::primitiveOf(const Value& root) const {
  const Value meshes = root["meshes"], nodes = root["nodes"];
  if (meshes.size() != 1)
    refuse(meshes.size() == 0 ? "has no mesh" : "has several meshes, each of which is a shape");
  const Value primitives = meshes[first]["primitives"];
  if (primitives.size() != 1)
    refuse(primitives.size() == 0 ? "has no primitive" : "has several primitives, each of which is a shape");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].has("skin"))
      refuse("has a skin");
  if (primitives[first]["targets"].size() > 0)
    refuse("has morph targets");
  if (primitives[first]["extensions"].has("KHR_draco_mesh_compression"))
    refuse("is compressed by Draco");
  return primitives[first];
}

ChunkedGlb::Array ChunkedGlb::arrayOf(Document& document, std::size_t accessor) const {
  const Value value = document.array("accessors")[accessor];
  const std::optional<std::size_t> view = value.index("bufferView", document.array("bufferViews"));
  if (!view || value.has("sparse"))
    refuse("has sparse accessors");
  const Value viewValue = document.array("bufferViews")[*view];
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (viewValue["extensions"].has(extension))
      refuse("is compressed by meshopt");
  const std::optional<std::size_t> buffer = viewValue.index("buffer", document.array("buffers"));
  if (buffer && (*buffer != 0 || document.array("buffers")[first].has("uri")))
    refuse("has vertices in other files");
  return {document.accessor(accessor), value.json()};
}

void ChunkedGlb::readArrays(Document& document, const Value& primitive) {
  const Value names = primitive["attributes"], accessors = document.array("accessors");
  if (!names.json().is_object())
    names.fail(ErrorKind::malformed, "is missing");
  for (const auto& [name, unused] : names.json().items()) {
    const std::optional<std::size_t> accessor = names.index(name.c_str(), accessors);
    if (!accessor)
      names.fail(ErrorKind::malformed, fmt::format("has no accessor for '{}'", asPrintable(name)));
    const Array& array = attributes_.emplace_back(name, arrayOf(document, *accessor)).second;
    if (attributes_.size() > 1 && array.accessor.count() != vertexCount_)
      names.fail(ErrorKind::malformed, fmt::format("have {} and {} elements", vertexCount_, array.accessor.count()));
    vertexCount_ = array.accessor.count();
  }
  const std::optional<std::size_t> indices = primitive.index("indices", accessors);
  if (!indices)
    return;
  indices_ = arrayOf(document, *indices);
  if (indices_->accessor.components() != 1 || !indices_->accessor.isUnsigned())
    primitive["indices"].fail(ErrorKind::malformed, "are no whole numbers");
}

std::vector<std::uint32_t> ChunkedGlb::cornersOf(const Chunk& chunk) const {
  const std::size_t begin = chunk.offset * cornersPerElement(topology_);
  std::vector<std::uint32_t> corners(chunk.records * cornersPerElement(topology_));
  std::iota(corners.begin(), corners.end(), static_cast<std::uint32_t>(begin));
  for (std::size_t i = 0; indices_ && i < corners.size(); ++i) {
    corners[i] = indices_->accessor.whole(begin + i, 0);
    if (corners[i] >= vertexCount_)
      throw Error(ErrorKind::malformed, name_,
                  fmt::format("has indices that name vertex {} of {}", corners[i], vertexCount_));
  }
  return corners;
}

Json ChunkedGlb::withPiece(Json document, const Chunk& chunk, Bytes& buffer) const {
  const std::size_t bufferIndex = document["buffers"].size();
  Json& primitive = document["meshes"][0]["primitives"][0];
  const auto addAccessor = [&](Json accessor, std::size_t count, std::size_t begin) {
    for (const char* bound : {"min", "max"})
      accessor.erase(bound);
    accessor["count"] = count;
    accessor["byteOffset"] = 0;
    accessor["bufferView"] = document["bufferViews"].size();
    Json view = Json::object();
    view["buffer"] = bufferIndex;
    view["byteOffset"] = begin;
    view["byteLength"] = buffer.size() - begin;
    document["bufferViews"].push_back(std::move(view));
    document["accessors"].push_back(std::move(accessor));
    return document["accessors"].size() - 1;
  };
  const std::vector<std::uint32_t> corners = cornersOf(chunk);
  const IndexRanks vertices{std::vector<std::uint32_t>(corners)};
  for (const std::uint32_t corner : corners)
    appendLittle(buffer, vertices.of(corner));
  Json ofIndices = Json::object();
  ofIndices["componentType"] = unsignedInt;
  ofIndices["type"] = "SCALAR";
  primitive["indices"] = addAccessor(std::move(ofIndices), corners.size(), 0);
  for (const auto& [name, array] : attributes_) {
    const std::size_t begin = buffer.size();
    for (const std::uint32_t vertex : vertices.indices()) {
      const ByteSpan element = array.accessor.bytesOf(vertex);
      buffer.insert(buffer.end(), element.begin(), element.end());
    }
    primitive["attributes"][name] = addAccessor(array.json, vertices.indices().size(), begin);
  }
  document["buffers"].push_back(Json::object());
  return document;
}

const std::set<std::size_t>& ChunkedGlb::texCoordSets(const References& references) const {
  std::call_once(haveTexCoordSets_, [&] {
    Document document(json_, binary_, references, name_, bytes().size());
    SceneGraph graph;
    MaterialReader materials(document, graph, false);
    const Value primitive = document.array("meshes")[first]["primitives"][first],
                mappings = primitive["extensions"]["KHR_materials_variants"]["mappings"];
    const auto add = [&](const Value& user) {
      try {
        if (const std::optional<std::size_t> material = user.index("material", document.array("materials"))) {
          const std::set<std::size_t>& sets = materials.texCoordSets(*material);
          texCoordSets_.insert(sets.begin(), sets.end());
        }
      } catch (const Error& error) { // of which the first piece warns
        if (error.kind() == ErrorKind::limit)
          throw;
      }
    };
    add(primitive);
    for (std::size_t i = 0; i < mappings.size(); ++i)
      add(mappings[i]);
  });
  return texCoordSets_;
}

Imported ChunkedGlb::read(std::size_t number, const ImportOptions& given) const {
  const ImportOptions options = beside(given, name_);
  const References references(options, name_);
  Json alone = Json::object();
  alone["meshes"] = Json::array({Json::object({{"primitives", json_["meshes"][0]["primitives"]}})});
  Bytes buffer;
  const Json json = withPiece(number == 0 ? json_ : alone, chunks_[number], buffer);
  Document document(json, binary_, references, name_, bytes().size());
  document.setBuffer(json["buffers"].size() - 1, std::move(buffer));
  if (number == 0) {
    Imported imported = readDocument(document, "GLB", options);
    if (imported.scene.meshes.size() != 1)
      throw Error(ErrorKind::malformed, name_, "has a mesh that no node of the scene shows");
    completeImport(imported, true, name_);
    return imported;
  }
  PrimitiveReader primitives(document, options.attributes, options.strict);
  Imported imported;
  imported.format = "GLB";
  imported.scene.meshes.push_back(
      primitives.read(document.array("meshes")[first]["primitives"][first], texCoordSets(references), 0));
  addRoot(imported.scene.graph, {"", Shape{}, {}, ""});
  imported.attributes.assign(primitives.furtherAttributes.begin(), primitives.furtherAttributes.end());
  warnOfNormals(imported.warnings, primitives.omissions.unusableNormals);
  return imported;
}

} // namespace imgeo
