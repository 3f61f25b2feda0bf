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

std::string locationOf(const std::string& name, std::uint32_t mesh, std::uint32_t primitive) {
  return fmt::format("{}, meshes[{}].primitives[{}]", name, mesh, primitive);
}

} // namespace

/// Reads primitives of a scene, of most of which one element.
class ChunkedGlb::PartReader : public PrimitiveReader {
public:
  /// `json`: the document of the scene. Everything must outlive this.
  PartReader(const ChunkedGlb& source, const Json& json, const std::set<const Counts*>& whole, PrimitiveDocument& parts,
             const ImportOptions& options)
      : PrimitiveReader(parts.document(), options.attributes, options.strict), source_(source), whole_(whole),
        parts_(parts) {
    findEntries(json);
  }

  Mesh read(const Value& primitive, const std::set<std::size_t>& texCoordSets, std::size_t jointCount) override {
    const Counts* counts = source_.countsOf(primitive.json());
    parts_.enter(primitive.json());
    const std::optional<Json> part = partOf(primitive, counts);
    Mesh mesh = PrimitiveReader::read(part ? Value(*part, primitive.location()) : primitive, texCoordSets, jointCount);
    if (part)
      checkWhole(primitive, primitive["mode"].whole(trianglesMode), counts->corners);
    const auto entry =
        std::ranges::lower_bound(entries_, &primitive.json(), std::less<>(), &std::pair<const Json*, Entry>::first);
    meshes.push_back({entry->second, texCoordSets, counts});
    return mesh;
  }

  std::vector<MeshOfScene> meshes; ///< that have been read

private:
  void findEntries(const Json& json) {
    const std::vector<std::vector<std::string_view>> texts = source_.text_.primitives();
    const auto found = json.find("meshes");
    if (found == json.end())
      return;
    std::uint32_t meshNumber = 0;
    for (const Json& mesh : *found) {
      const auto primitives = mesh.is_object() ? mesh.find("primitives") : mesh.end();
      if (mesh.is_object() && primitives != mesh.end() && primitives->is_array())
        for (std::uint32_t i = 0; i < primitives->size(); ++i)
          entries_.push_back({&(*primitives)[i], {meshNumber, i, texts.at(meshNumber).at(i)}});
      ++meshNumber;
    }
    std::ranges::sort(entries_, std::less<>(), &std::pair<const Json*, Entry>::first);
  }

  /// A primitive of the first element; none where the primitive is read whole.
  std::optional<Json> partOf(const Value& primitive, const Counts* counts) {
    if (!counts || counts->elements == 0 || whole_.contains(counts))
      return std::nullopt;
    const Arrays arrays = source_.arraysOf(parts_.document(), primitive);
    if (!source_.hasFirstElement(arrays))
      return std::nullopt;
    return source_.pieceOf(parts_, primitive.json(), arrays, 0, 1);
  }

  const ChunkedGlb& source_;
  const std::set<const Counts*>& whole_;
  PrimitiveDocument& parts_;
  std::vector<std::pair<const Json*, Entry>> entries_; ///< by address
};

ChunkedGlb::ChunkedGlb(SourceContent content, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content)), chunks_(chunksOf(bytes(), name_)), text_(chunks_.json, name_) {
  {
    const References references({}, name_);
    const Json json = text_.document();
    Document document(json, chunks_.binary, references, name_, bytes().size());
    checkSupported(document.root());
    PrimitiveDocument primitives = primitiveDocument(references);
    findCounts(document, primitives);
  }
  readScene({}, {}, ofScene_);
  ofScene_.shrink_to_fit();
  removeMeshes();
  for (const MeshOfScene& mesh : ofScene_) {
    beginMesh(mesh.counts ? mesh.counts->topology : Topology::triangles);
    const std::uint64_t count = mesh.counts ? mesh.counts->elements : 0;
    for (std::uint64_t begin = 0; begin < count; begin += chunkRecords) {
      const std::uint64_t records = std::min(chunkRecords, count - begin);
      add({static_cast<std::size_t>(begin), static_cast<std::size_t>(begin + records), records, records});
    }
  }
}

void ChunkedGlb::refuse(const char* reason) const {
  throw Error(ErrorKind::unsupported, name_, fmt::format("{}, and is not read piece by piece", reason));
}

void ChunkedGlb::findCounts(Document& document, PrimitiveDocument& primitives) {
  const Value meshes = document.array("meshes"), nodes = document.array("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].has("skin"))
      refuse("has a skin");
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (std::size_t p = 0; p < meshes[i]["primitives"].size(); ++p) {
      const Value primitive = meshes[i]["primitives"][p];
      std::string key = keyOf(primitive.json());
      if (counts_.contains(key))
        continue;
      try {
        primitives.enter(primitive.json());
        const Arrays arrays = arraysOf(primitives.document(), primitive);
        const std::size_t corners = arrays.indices ? arrays.indices->accessor.count() : arrays.vertexCount;
        counts_.emplace(std::move(key), Counts{corners / cornersPerElement(arrays.topology), arrays.topology, corners});
      } catch (const Error& error) { // the scene is read without what is damaged
        if (error.kind() != ErrorKind::malformed && error.kind() != ErrorKind::truncated)
          throw;
      }
    }
}

PrimitiveDocument ChunkedGlb::primitiveDocument(const References& references) const {
  return {text_, chunks_.binary, references, name_, bytes().size()};
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

const ChunkedGlb::Counts* ChunkedGlb::countsOf(const Json& primitive) const {
  const auto found = counts_.find(keyOf(primitive));
  return found == counts_.end() ? nullptr : &found->second;
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

Json ChunkedGlb::pieceOf(PrimitiveDocument& parts, Json primitive, const Arrays& arrays, std::size_t begin,
                         std::size_t count) const {
  Json& document = parts.json();
  Bytes buffer;
  const auto addAccessor = [&](Json accessor, std::size_t elements, std::size_t offset) {
    for (const char* bound : {"min", "max"})
      accessor.erase(bound);
    accessor["count"] = elements;
    accessor["byteOffset"] = 0;
    accessor["bufferView"] = document["bufferViews"].size();
    Json view = Json::object();
    view["buffer"] = document["buffers"].size();
    view["byteOffset"] = offset;
    view["byteLength"] = buffer.size() - offset;
    document["bufferViews"].push_back(std::move(view));
    document["accessors"].push_back(std::move(accessor));
    return document["accessors"].size() - 1;
  };
  const std::vector<std::uint32_t> corners = cornersOf(arrays, begin, count);
  const IndexRanks vertices{std::vector<std::uint32_t>(corners)};
  for (const std::uint32_t corner : corners)
    appendLittle(buffer, vertices.of(corner));
  Json ofIndices = Json::object();
  ofIndices["componentType"] = unsignedInt;
  ofIndices["type"] = "SCALAR";
  primitive["indices"] = addAccessor(std::move(ofIndices), corners.size(), 0);
  for (const auto& [name, array] : arrays.attributes) {
    const std::size_t attributeOffset = buffer.size();
    for (const std::uint32_t vertex : vertices.indices()) {
      const ByteSpan element = array.accessor.bytesOf(vertex);
      buffer.insert(buffer.end(), element.begin(), element.end());
    }
    primitive["attributes"][name] = addAccessor(array.json, vertices.indices().size(), attributeOffset);
  }
  parts.addBuffer(std::move(buffer));
  return primitive;
}

Imported ChunkedGlb::readScene(const std::set<const Counts*>& whole, const ImportOptions& given,
                               std::vector<MeshOfScene>& meshes) const {
  const ImportOptions options = besideFile(given);
  const References references(options, name_);
  const Json json = text_.document();
  PrimitiveDocument parts = primitiveDocument(references);
  PartReader primitives(*this, json, whole, parts, options);
  Document document(json, chunks_.binary, references, name_, bytes().size());
  Imported imported = readDocument(document, "GLB", options, primitives);
  completeImport(imported, true, options, name_);
  meshes = std::move(primitives.meshes);
  return imported;
}

Imported ChunkedGlb::readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const {
  std::set<const Counts*> wholeCounts;
  for (const std::size_t mesh : whole)
    wholeCounts.insert(ofScene_.at(mesh).counts);
  std::vector<MeshOfScene> read;
  Imported imported = readScene(wholeCounts, options, read);
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

Imported ChunkedGlb::readMeshes(const std::set<std::size_t>& meshes, const ImportOptions& given) const {
  const ImportOptions options = besideFile(given);
  const References references(options, name_);
  PrimitiveDocument parts = primitiveDocument(references);
  PrimitiveReader primitives(parts.document(), options.attributes, options.strict);
  Imported imported;
  imported.format = "GLB";
  for (const std::size_t number : meshes) {
    const MeshOfScene& mesh = ofScene_.at(number);
    const Json primitive = Json::parse(mesh.entry.text);
    const Value value(primitive, locationOf(name_, mesh.entry.mesh, mesh.entry.primitive));
    parts.enter(primitive);
    Mesh& read = imported.scene.meshes.emplace_back();
    try {
      read = primitives.read(value, mesh.texCoordSets, 0);
      completeCreases(read, options);
    } catch (const Error& error) {
      if (options.strict || error.kind() == ErrorKind::limit)
        throw;
      imported.warnings.push_back(leftOut(error));
    }
  }
  imported.attributes.assign(primitives.furtherAttributes.begin(), primitives.furtherAttributes.end());
  warnOfNormals(imported.warnings, primitives.omissions.unusableNormals);
  return imported;
}

Imported ChunkedGlb::readChunk(const Chunk& chunk, const ImportOptions& given) const {
  const ImportOptions options = besideFile(given);
  const References references(options, name_);
  const MeshOfScene& mesh = ofScene_[chunk.mesh];
  PrimitiveDocument parts = primitiveDocument(references);
  const Json primitive = Json::parse(mesh.entry.text);
  parts.enter(primitive);
  const Arrays arrays = arraysOf(parts.document(), Value(primitive, name_, ", "));
  const Json piece = pieceOf(parts, primitive, arrays, chunk.offset, chunk.records);
  PrimitiveReader primitives(parts.document(), options.attributes, options.strict);
  Imported imported;
  imported.format = "GLB";
  imported.scene.meshes.push_back(primitives.read(Value(piece, name_, ", "), mesh.texCoordSets, 0));
  addRoot(imported.scene.graph, {"", Shape{}, {}, ""});
  imported.attributes.assign(primitives.furtherAttributes.begin(), primitives.furtherAttributes.end());
  warnOfNormals(imported.warnings, primitives.omissions.unusableNormals);
  return imported;
}

} // namespace imgeo
