#include "import/chunks/chunked_glb.h"

#include "base/error.h"
#include "import/chunks/index_ranks.h"
#include "import/complete_import.h"
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

/// What decides about the mesh of a primitive, but for the sets of texture coordinates that its material uses.
std::string keyOf(Json primitive) {
  if (primitive.is_object())
    for (const char* member : {"material", "extras"})
      primitive.erase(member);
  return primitive.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Calls visit(primitive) for all primitives of a document.
template <typename Visit> void forEachPrimitive(Json& document, Visit visit) {
  for (Json& mesh : document["meshes"])
    if (mesh.is_object() && mesh.contains("primitives") && mesh["primitives"].is_array())
      std::ranges::for_each(mesh["primitives"], visit);
}

} // namespace

ChunkedGlb::ChunkedGlb(SourceContent content, std::uint64_t chunkRecords) : ChunkedSource(std::move(content)) {
  const GlbChunks chunks = chunksOf(bytes(), name_);
  json_ = parseJson(chunks.json, name_);
  binary_ = chunks.binary;
  const References references({}, name_);
  Document document(json_, binary_, references, name_, bytes().size());
  checkSupported(document.root());
  findArrays(document);
  readScene({}, {}, ofScene_);
  removeMeshes();
  for (const MeshOfScene& mesh : ofScene_) {
    beginMesh(mesh.arrays ? mesh.arrays->topology : Topology::triangles);
    const std::uint64_t count = mesh.arrays ? mesh.arrays->elementCount() : 0;
    for (std::uint64_t begin = 0; begin < count; begin += chunkRecords) {
      const std::uint64_t records = std::min(chunkRecords, count - begin);
      add({static_cast<std::size_t>(begin), static_cast<std::size_t>(begin + records), records, records});
    }
  }
}

void ChunkedGlb::refuse(const char* reason) const {
  throw Error(ErrorKind::unsupported, name_, fmt::format("{}, and is not read piece by piece", reason));
}

void ChunkedGlb::findArrays(Document& document) {
  const Value meshes = document.array("meshes"), nodes = document.array("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].has("skin"))
      refuse("has a skin");
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (std::size_t p = 0; p < meshes[i]["primitives"].size(); ++p) {
      const Value primitive = meshes[i]["primitives"][p];
      try {
        if (!arraysOf(primitive.json()))
          arrays_.emplace(keyOf(primitive.json()), arraysOf(document, primitive));
      } catch (const Error& error) { // the scene is read without what is damaged
        if (error.kind() != ErrorKind::malformed && error.kind() != ErrorKind::truncated)
          throw;
      }
    }
}

ChunkedGlb::Arrays ChunkedGlb::arraysOf(Document& document, const Value& primitive) const {
  if (primitive["targets"].size() > 0)
    refuse("has morph targets");
  if (primitive["extensions"].has("KHR_draco_mesh_compression"))
    refuse("is compressed by Draco");
  const std::uint64_t mode = primitive["mode"].whole(trianglesMode);
  if (mode != trianglesMode && mode != pointsMode)
    refuse("has lines, strips or fans");
  Arrays arrays;
  arrays.topology = mode == pointsMode ? Topology::points : Topology::triangles;
  const Value names = primitive["attributes"], accessors = document.array("accessors");
  if (!names.json().is_object())
    names.fail(ErrorKind::malformed, "is missing");
  for (const auto& [name, unused] : names.json().items()) {
    const std::optional<std::size_t> accessor = names.index(name.c_str(), accessors);
    if (!accessor)
      names.fail(ErrorKind::malformed, fmt::format("has no accessor for '{}'", asPrintable(name)));
    const Array& array = arrays.attributes.emplace_back(name, arrayOf(document, *accessor)).second;
    if (arrays.attributes.size() > 1 && array.accessor.count() != arrays.vertexCount)
      names.fail(ErrorKind::malformed,
                 fmt::format("have {} and {} elements", arrays.vertexCount, array.accessor.count()));
    arrays.vertexCount = array.accessor.count();
  }
  const std::optional<std::size_t> indices = primitive.index("indices", accessors);
  if (!indices)
    return arrays;
  arrays.indices = arrayOf(document, *indices);
  if (arrays.indices->accessor.components() != 1 || !arrays.indices->accessor.isUnsigned())
    primitive["indices"].fail(ErrorKind::malformed, "are no whole numbers");
  return arrays;
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
  const Value buffers = document.array("buffers");
  const std::optional<std::size_t> buffer = viewValue.index("buffer", buffers);
  if (buffer && (*buffer != 0 || buffers[*buffer].has("uri")))
    refuse("has vertices in other files");
  return {document.accessor(accessor), value.json()};
}

const ChunkedGlb::Arrays* ChunkedGlb::arraysOf(const Json& primitive) const {
  const auto found = arrays_.find(keyOf(primitive));
  return found == arrays_.end() ? nullptr : &found->second;
}

std::vector<std::uint32_t> ChunkedGlb::cornersOf(const Arrays& arrays, std::size_t begin, std::size_t count) const {
  const std::size_t first = begin * cornersPerElement(arrays.topology);
  std::vector<std::uint32_t> corners(count * cornersPerElement(arrays.topology));
  std::iota(corners.begin(), corners.end(), static_cast<std::uint32_t>(first));
  for (std::size_t i = 0; arrays.indices && i < corners.size(); ++i) {
    corners[i] = arrays.indices->accessor.whole(first + i, 0);
    if (corners[i] >= arrays.vertexCount)
      throw Error(ErrorKind::malformed, name_,
                  fmt::format("has indices that name vertex {} of {}", corners[i], arrays.vertexCount));
  }
  return corners;
}

bool ChunkedGlb::hasFirstElement(const Arrays& arrays) const {
  try {
    cornersOf(arrays, 0, 1);
    return true;
  } catch (const Error&) {
    return false;
  }
}

void ChunkedGlb::setPiece(Json& document, Json& primitive, const Arrays& arrays, std::size_t begin, std::size_t count,
                          Bytes& buffer) const {
  const auto addAccessor = [&](Json accessor, std::size_t elements, std::size_t offset) {
    for (const char* bound : {"min", "max"})
      accessor.erase(bound);
    accessor["count"] = elements;
    accessor["byteOffset"] = 0;
    accessor["bufferView"] = document["bufferViews"].size();
    Json view = Json::object();
    view["buffer"] = document["buffers"].size() - 1;
    view["byteOffset"] = offset;
    view["byteLength"] = buffer.size() - offset;
    document["bufferViews"].push_back(std::move(view));
    document["accessors"].push_back(std::move(accessor));
    return document["accessors"].size() - 1;
  };
  const std::vector<std::uint32_t> corners = cornersOf(arrays, begin, count);
  const IndexRanks vertices{std::vector<std::uint32_t>(corners)};
  const std::size_t offset = buffer.size();
  for (const std::uint32_t corner : corners)
    appendLittle(buffer, vertices.of(corner));
  Json ofIndices = Json::object();
  ofIndices["componentType"] = unsignedInt;
  ofIndices["type"] = "SCALAR";
  primitive["indices"] = addAccessor(std::move(ofIndices), corners.size(), offset);
  for (const auto& [name, array] : arrays.attributes) {
    const std::size_t attributeOffset = buffer.size();
    for (const std::uint32_t vertex : vertices.indices()) {
      const ByteSpan element = array.accessor.bytesOf(vertex);
      buffer.insert(buffer.end(), element.begin(), element.end());
    }
    primitive["attributes"][name] = addAccessor(array.json, vertices.indices().size(), attributeOffset);
  }
}

Imported ChunkedGlb::readScene(const std::set<const Arrays*>& whole, const ImportOptions& given,
                               std::vector<MeshOfScene>& meshes) const {
  const ImportOptions options = besideFile(given);
  const References references(options, name_);
  Json json = json_;
  Bytes buffer;
  std::map<const Json*, const Arrays*> arraysOfPrimitive;
  std::map<const Arrays*, Json> pieces; // primitives that are alike stay alike
  if (!arrays_.empty())                 // otherwise the document may have no arrays of buffers, views and accessors
    json["buffers"].push_back(Json::object());
  forEachPrimitive(json, [&](Json& primitive) {
    const Arrays* arrays = arraysOf(primitive);
    arraysOfPrimitive[&primitive] = arrays;
    if (!arrays || arrays->elementCount() == 0 || whole.contains(arrays) || !hasFirstElement(*arrays))
      return;
    const auto [piece, isNew] = pieces.try_emplace(arrays);
    if (isNew) {
      piece->second = primitive;
      setPiece(json, piece->second, *arrays, 0, 1, buffer);
    }
    primitive["indices"] = piece->second["indices"];
    primitive["attributes"] = piece->second["attributes"];
  });
  Document document(json, binary_, references, name_, bytes().size());
  if (!arrays_.empty())
    document.setBuffer(json["buffers"].size() - 1, std::move(buffer));
  std::vector<ReadPrimitive> primitives;
  Imported imported = readDocument(document, "GLB", options, &primitives);
  completeImport(imported, true, name_);
  for (ReadPrimitive& primitive : primitives)
    meshes.push_back({*primitive.json, std::move(primitive.texCoordSets), arraysOfPrimitive.at(primitive.json)});
  return imported;
}

Imported ChunkedGlb::readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const {
  std::set<const Arrays*> wholeArrays;
  for (const std::size_t mesh : whole)
    wholeArrays.insert(ofScene_.at(mesh).arrays);
  std::vector<MeshOfScene> read;
  Imported imported = readScene(wholeArrays, options, read);
  // Meshes that were found to be damaged when all of them was read are missing.
  std::map<decltype(read.front().key()), std::size_t> numbers;
  for (std::size_t i = 0; i < ofScene_.size(); ++i)
    numbers[ofScene_[i].key()] = i;
  std::vector<Mesh> meshes(ofScene_.size());
  std::vector<std::size_t> numberOf;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto found = numbers.find(read[i].key());
    if (found == numbers.end())
      throw Error(ErrorKind::malformed, name_, "has other meshes when it is read again");
    numberOf.push_back(found->second);
    meshes[found->second] = std::move(imported.scene.meshes[i]);
  }
  for (const std::size_t node : shapeNodes(imported.scene.graph)) {
    Shape& shape = std::get<Shape>(imported.scene.graph.nodes[node].content);
    shape.mesh = numberOf[shape.mesh];
  }
  imported.scene.meshes = std::move(meshes);
  return imported;
}

Imported ChunkedGlb::readChunk(const Chunk& chunk, const ImportOptions& given) const {
  const ImportOptions options = besideFile(given);
  const References references(options, name_);
  const MeshOfScene& mesh = ofScene_[chunk.mesh];
  Json json = Json::object();
  json["buffers"] = {Json::object(), Json::object()}; // of the file, of the piece
  Json primitive = mesh.primitive;
  Bytes buffer;
  setPiece(json, primitive, *mesh.arrays, chunk.offset, chunk.records, buffer);
  Document document(json, binary_, references, name_, bytes().size());
  document.setBuffer(1, std::move(buffer));
  PrimitiveReader primitives(document, options.attributes, options.strict);
  Imported imported;
  imported.format = "GLB";
  imported.scene.meshes.push_back(primitives.read(Value(primitive, name_, ", "), mesh.texCoordSets, 0));
  addRoot(imported.scene.graph, {"", Shape{}, {}, ""});
  imported.attributes.assign(primitives.furtherAttributes.begin(), primitives.furtherAttributes.end());
  warnOfNormals(imported.warnings, primitives.omissions.unusableNormals);
  return imported;
}

} // namespace imgeo
