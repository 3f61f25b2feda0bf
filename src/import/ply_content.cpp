#include "import/ply_content.h"

#include "import/ply_faces.h"
#include "import/ply_records.h"
#include "import/ply_vertices.h"

#include <algorithm>
#include <limits>

namespace imgeo {

namespace {

template <typename Cursor>
void readVertices(PlyRecords<Cursor>& records, const PlyElement& element, PlyContent& content) {
  PlyVertexReader reader(element, content);
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

template <typename Cursor> PlyContent readContent(Cursor cursor, const PlyHeader& header) {
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
      readVertices(records, element, content);
    else if (element.name == "face")
      faces.readFaces(element);
    else if (element.name == "tristrips")
      faces.readStrips(element);
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

PlyContent readPlyContent(ByteSpan bytes, const PlyHeader& header, const std::string& name) {
  const std::size_t from = header.bodyOffset;
  switch (header.encoding) {
  case PlyEncoding::ascii:
    return readContent(AsciiPlyCursor(bytes, name, from), header);
  case PlyEncoding::littleEndian:
    return readContent(BinaryPlyCursor<std::endian::little>(bytes, name, from), header);
  case PlyEncoding::bigEndian:
    break;
  }
  return readContent(BinaryPlyCursor<std::endian::big>(bytes, name, from), header);
}

} // namespace imgeo
