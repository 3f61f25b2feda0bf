#include "import/ply/content.h"
#include "import/mesh/far_origin.h"
#include "import/ply/textures.h"

#include "import/ply/chunks.h"
#include "import/ply/faces.h"
#include "import/ply/records.h"
#include "import/ply/vertices.h"

#include <algorithm>
#include <array>
#include <limits>

namespace imgeo {

namespace {

template <typename Cursor>
void readVertices(PlyRecords<Cursor>& records, const PlyElement& element, const AttributeChoice& kept,
                  PlyContent& content) {
  PlyVertexReader reader(element, kept, content);
  if (!reader.hasPosition())
    records.fail(ErrorKind::malformed, "the vertices have no x, y and z");
  reader.read(records);
}

template <typename Cursor>
void skipElement(PlyRecords<Cursor>& records, const PlyElement& element, PlyContent& content) {
  if (element.count > 0)
    content.ignored.push_back(fmt::format("element '{}'", asPrintable(element.name)));
  records.forEach(element, [&] {
    for (const PlyProperty& property : element.properties)
      records.skip(property);
  });
}

/// Whether an element holds edges as Blender, MeshLab and Open3D write them: two vertex indices.
bool isEdge(const PlyElement& element) {
  const auto isIndex = [&](const char* name) {
    const PlyProperty* property = element.find(name);
    return property && !property->isList() && isInteger(property->type);
  };
  return element.name == "edge" && isIndex("vertex1") && isIndex("vertex2");
}

template <typename Cursor>
void readEdges(PlyRecords<Cursor>& records, const PlyElement& element, std::uint64_t vertexCount, PlyContent& content) {
  records.checkCount(element);
  content.edges.reserve(2 * element.count);
  for (const PlyProperty& property : element.properties)
    if (property.name != "vertex1" && property.name != "vertex2")
      content.noteIgnored(element, property);
  records.forEach(element, [&] {
    std::array<std::uint32_t, 2> edge{};
    for (const PlyProperty& property : element.properties)
      if (property.name == "vertex1" || property.name == "vertex2")
        edge[property.name == "vertex2"] = records.vertexIndex(property.type, vertexCount);
      else
        records.skip(property);
    content.edges.insert(content.edges.end(), edge.begin(), edge.end());
  });
}

template <typename Cursor>
void readElement(PlyRecords<Cursor>& records, const PlyElement& element, std::uint64_t vertexCount,
                 const AttributeChoice& kept, PlyContent& content) {
  if (element.name == "vertex")
    readVertices(records, element, kept, content);
  else if (element.name == "face")
    PlyFaceReader<Cursor>(records, content, vertexCount).readFaces(element);
  else if (element.name == "tristrips")
    PlyFaceReader<Cursor>(records, content, vertexCount).readStrips(element);
  else if (isEdge(element))
    readEdges(records, element, vertexCount, content);
  else
    skipElement(records, element, content);
}

bool isCoordinate(const PlyProperty& property) {
  return !property.isList() && (property.name == "x" || property.name == "y" || property.name == "z");
}

/// Whether coordinates may have more digits than single precision. Those of text may, whatever type the header states.
bool isPrecise(const PlyElement& vertices, PlyEncoding encoding) {
  return encoding == PlyEncoding::ascii || std::ranges::any_of(vertices.properties, [](const PlyProperty& property) {
           return isCoordinate(property) && (property.type == PlyType::float64 || property.type == PlyType::int32 ||
                                             property.type == PlyType::uint32);
         });
}

/// Vertices whose coordinates are read with all their digits.
PlyElement withDoubles(PlyElement vertices) {
  for (PlyProperty& property : vertices.properties)
    if (isCoordinate(property) && property.type == PlyType::float32)
      property.type = PlyType::float64;
  return vertices;
}

/// Chooses the origin of vertices that begin at the cursor.
template <typename Cursor>
Vec3d originAt(const PlyRecords<Cursor>& records, const PlyElement& vertices, PlyEncoding encoding) {
  if (!isPrecise(vertices, encoding))
    return {0, 0, 0};
  const auto first =
      PlyVertexReader::firstPosition(records, encoding == PlyEncoding::ascii ? withDoubles(vertices) : vertices);
  return first ? farOriginOf(*first) : Vec3d{0, 0, 0};
}

template <typename Cursor>
PlyContent readContent(ByteSpan bytes, const PlyHeader& header, const std::string& name, const AttributeChoice& kept,
                       const std::optional<Vec3d>& origin) {
  PlyContent content;
  PlyRecords<Cursor> records(Cursor(bytes, name, header.bodyOffset));
  [[maybe_unused]] PlyChunkReader chunkReader(bytes, name);
  const PlyElement* vertices = header.find("vertex");
  if (!vertices)
    records.fail(ErrorKind::malformed, "the header has no element 'vertex'");
  if (vertices->count > std::numeric_limits<std::uint32_t>::max())
    records.fail(ErrorKind::limit, fmt::format("{} vertices are more than 32-bit indices can name", vertices->count));

  for (const PlyElement& stated : header.elements) {
    PlyElement element = stated;
    if (&stated == vertices) {
      content.origin = origin ? *origin : originAt(records, stated, header.encoding);
      // Without an origin, numbers of text are rounded to the type that the header states at once.
      if (header.encoding == PlyEncoding::ascii && content.origin != Vec3d{0, 0, 0})
        element = withDoubles(stated);
    }
    if constexpr (std::is_same_v<Cursor, AsciiPlyCursor>)
      if (chunkReader.read(records.cursor(), element, content,
                           [&](AsciiPlyRecords& chunkRecords, const PlyElement& chunk, PlyContent& chunkContent) {
                             chunkContent.origin = content.origin;
                             readElement(chunkRecords, chunk, vertices->count, kept, chunkContent);
                           }))
        continue;
    readElement(records, element, vertices->count, kept, content);
  }
  if (!content.cornerTexCoords.empty())
    content.cornerTexCoords.resize(content.indices.size());
  if (!content.textures.empty())
    content.textures.resize(content.polygonCount(), noPlyTexture);
  content.trailingBytes = records.trailingBytes();
  return content;
}

} // namespace

void PlyContent::noteIgnored(const PlyElement& element, const PlyProperty& property) {
  if (element.count > 0)
    ignored.push_back(fmt::format("'{}' of '{}'", asPrintable(property.name), element.name));
}

void PlyContent::append(std::vector<PlyContent>& chunks) {
  // These are the same in all chunks.
  ignored.insert(ignored.end(), chunks[0].ignored.begin(), chunks[0].ignored.end());
  namedAttributes.insert(namedAttributes.end(), chunks[0].namedAttributes.begin(), chunks[0].namedAttributes.end());
  const auto reserve = [&](auto member) {
    std::size_t count = (this->*member).size();
    for (const PlyContent& chunk : chunks)
      count += (chunk.*member).size();
    (this->*member).reserve(count);
  };
  reserve(&PlyContent::positions);
  reserve(&PlyContent::indices);
  for (PlyContent& chunk : chunks) {
    append(chunk);
    chunk = {};
  }
}

void PlyContent::append(const PlyContent& chunk) {
  const auto add = [](auto& values, const auto& more) { values.insert(values.end(), more.begin(), more.end()); };
  imgeo::append(attributes, positions.size(), chunk.attributes, chunk.positions.size());
  add(positions, chunk.positions);
  if (!chunk.textures.empty())
    textures.resize(polygonCount(), noPlyTexture);
  add(textures, chunk.textures);
  if (!chunk.sizes.empty() && sizes.empty())
    sizes.assign(indices.size() / 3, 3);
  else if (chunk.sizes.empty() && !sizes.empty())
    sizes.insert(sizes.end(), chunk.indices.size() / 3, 3);
  add(sizes, chunk.sizes);
  if (!chunk.cornerTexCoords.empty())
    cornerTexCoords.resize(indices.size());
  add(cornerTexCoords, chunk.cornerTexCoords);
  add(indices, chunk.indices);
  add(edges, chunk.edges);
  facesTooSmall += chunk.facesTooSmall;
  colorsClamped += chunk.colorsClamped;
  maxRounding = std::max(maxRounding, chunk.maxRounding);
}

PlyContent readPlyContent(ByteSpan bytes, const PlyHeader& header, const std::string& name, const AttributeChoice& kept,
                          const std::optional<Vec3d>& origin) {
  switch (header.encoding) {
  case PlyEncoding::ascii:
    return readContent<AsciiPlyCursor>(bytes, header, name, kept, origin);
  case PlyEncoding::littleEndian:
    return readContent<BinaryPlyCursor<std::endian::little>>(bytes, header, name, kept, origin);
  case PlyEncoding::bigEndian:
    break;
  }
  return readContent<BinaryPlyCursor<std::endian::big>>(bytes, header, name, kept, origin);
}

Vec3d plyOriginOf(ByteSpan bytes, const PlyHeader& header, std::size_t offset, const std::string& name) {
  const PlyElement* vertices = header.find("vertex");
  if (!vertices)
    return {0, 0, 0};
  const auto at = [&]<typename Cursor>(Cursor cursor) {
    return originAt(PlyRecords<Cursor>(cursor), *vertices, header.encoding);
  };
  switch (header.encoding) {
  case PlyEncoding::ascii:
    return at(AsciiPlyCursor(bytes, name, offset));
  case PlyEncoding::littleEndian:
    return at(BinaryPlyCursor<std::endian::little>(bytes, name, offset));
  case PlyEncoding::bigEndian:
    break;
  }
  return at(BinaryPlyCursor<std::endian::big>(bytes, name, offset));
}

} // namespace imgeo
