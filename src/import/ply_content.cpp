#include "import/ply_content.h"

#include "import/ply_faces.h"
#include "import/ply_records.h"
#include "import/ply_vertices.h"

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

/// Two vertices each, as Blender, MeshLab and Open3D write them.
bool isEdge(const PlyElement& element) {
  const auto isIndex = [&](const char* name) {
    const PlyProperty* property = element.find(name);
    return property && !property->isList() && isInteger(property->type);
  };
  return element.name == "edge" && isIndex("vertex1") && isIndex("vertex2");
}

template <typename Cursor>
void readEdges(PlyRecords<Cursor>& records, const PlyElement& element, std::uint64_t vertexCount,
               PlyContent& content) {
  records.checkCount(element);
  content.edges.reserve(2 * element.count);
  for (const PlyProperty& property : element.properties)
    if (property.name != "vertex1" && property.name != "vertex2")
      content.noteIgnored(element, property);
  records.forEach(element, [&] {
    std::array<std::uint32_t, 2> edge{};
    for (const PlyProperty& property : element.properties)
      if (property.name == "vertex1" || property.name == "vertex2")
        edge[property.name == "vertex2"] = records.vertexNumber(property.type, vertexCount);
      else
        records.skip(property);
    content.edges.insert(content.edges.end(), edge.begin(), edge.end());
  });
}

template <typename Cursor>
PlyContent readContent(Cursor cursor, const PlyHeader& header, const AttributeChoice& kept) {
  PlyContent content;
  PlyRecords<Cursor> records(cursor);
  const PlyElement* vertices = header.find("vertex");
  if (!vertices)
    records.fail(ErrorKind::malformed, "the header has no element 'vertex'");
  if (vertices->count > std::numeric_limits<std::uint32_t>::max())
    records.fail(ErrorKind::limit,
                 fmt::format("{} vertices are more than 32-bit indices can name", vertices->count));

  PlyFaceReader<Cursor> faces(records, content, vertices->count);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex")
      readVertices(records, element, kept, content);
    else if (element.name == "face")
      faces.readFaces(element);
    else if (element.name == "tristrips")
      faces.readStrips(element);
    else if (isEdge(element))
      readEdges(records, element, vertices->count, content);
    else
      skipElement(records, element, content);
  }
  if (!content.cornerTexCoords.empty())
    content.cornerTexCoords.resize(content.indices.size());
  content.trailingBytes = records.trailingBytes();
  return content;
}

} // namespace

void PlyContent::noteIgnored(const PlyElement& element, const PlyProperty& property) {
  if (element.count > 0)
    ignored.push_back(fmt::format("'{}' of '{}'", asPrintable(property.name), element.name));
}

PlyContent readPlyContent(ByteSpan bytes, const PlyHeader& header, const std::string& name,
                          const AttributeChoice& kept) {
  const std::size_t from = header.bodyOffset;
  switch (header.encoding) {
  case PlyEncoding::ascii:
    return readContent(AsciiPlyCursor(bytes, name, from), header, kept);
  case PlyEncoding::littleEndian:
    return readContent(BinaryPlyCursor<std::endian::little>(bytes, name, from), header, kept);
  case PlyEncoding::bigEndian:
    break;
  }
  return readContent(BinaryPlyCursor<std::endian::big>(bytes, name, from), header, kept);
}

} // namespace imgeo
