#include "import/x3d/corner_runs.h"

#include "import/x3d/vertex_data_reader.h"

#include <fmt/format.h>
#include <initializer_list>
#include <map>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

namespace {

using Indices = std::vector<std::int32_t>;

/// Reads the corners of one geometry node.
class CornerReader {
public:
  CornerReader(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces)
      : source_(source), node_(node), data_(data), faces_(faces) {}

  using Readers = std::map<std::string_view, void (CornerReader::*)()>;
  static const Readers& readers() {
    static const Readers readers{{"IndexedFaceSet", &CornerReader::readIndexedFaces},
                                 {"TriangleSet", &CornerReader::readTriangles},
                                 {"TriangleStripSet", &CornerReader::readStrips},
                                 {"TriangleFanSet", &CornerReader::readFans},
                                 {"IndexedTriangleSet", &CornerReader::readTriangles},
                                 {"IndexedTriangleStripSet", &CornerReader::readStrips},
                                 {"IndexedTriangleFanSet", &CornerReader::readFans},
                                 {"QuadSet", &CornerReader::readQuads},
                                 {"IndexedQuadSet", &CornerReader::readQuads},
                                 {"IndexedLineSet", &CornerReader::readIndexedLines},
                                 {"LineSet", &CornerReader::readLines},
                                 {"PointSet", &CornerReader::readPoints},
                                 {"TriangleSet2D", &CornerReader::readTriangles2D},
                                 {"Polyline2D", &CornerReader::readPolyline2D},
                                 {"Polypoint2D", &CornerReader::readPolypoint2D}};
    return readers;
  }

  void read() { (this->*readers().at(node_.name()))(); }

private:
  Indices integers(const char* field) const { return source_.integers(node_, field); }

  /// Adds a face of vertices, which are indices into the Coordinate node.
  void addFace(std::initializer_list<std::uint32_t> vertices) {
    for (const std::uint32_t vertex : vertices)
      faces_.corners.push_back({vertex, none, none, none});
    faces_.ends.push_back(faces_.corners.size());
  }

  /// The index of a corner's attribute value: from the attribute's index field, or the vertex index where that is
  /// empty.
  static std::uint32_t valueIndex(const Indices& index, std::size_t at, std::uint32_t vertex) {
    if (index.empty())
      return vertex;
    return at < index.size() && index[at] >= 0 ? static_cast<std::uint32_t>(index[at]) : none;
  }

  // 11.2.2.4: attributes have one value per vertex or per face.
  void readIndexedFaces() { readRuns(Topology::triangles); }
  void readIndexedLines() { readRuns(Topology::lines); }

  /// Reads the runs of coordIndex, separated by -1, with the parallel indices of attributes.
  void readRuns(Topology topology) {
    const Indices coordIndex = integers("coordIndex"), normalIndex = integers("normalIndex"),
                  colorIndex = integers("colorIndex"), texCoordIndex = integers("texCoordIndex");
    const bool normalPerVertex = source_.boolean(node_, "normalPerVertex", true),
               colorPerVertex = source_.boolean(node_, "colorPerVertex", true);
    std::uint32_t face = 0;
    for (std::size_t at = 0; at < coordIndex.size(); ++at) {
      if (coordIndex[at] < 0) {
        if (faces_.corners.size() > (faces_.ends.empty() ? 0 : faces_.ends.back()))
          faces_.ends.push_back(faces_.corners.size());
        ++face;
        continue;
      }
      const auto vertex = static_cast<std::uint32_t>(coordIndex[at]);
      Corner corner{vertex, none, none, none};
      if (!data_.normals.empty())
        corner.normal = normalPerVertex ? valueIndex(normalIndex, at, vertex) : valueIndex(normalIndex, face, face);
      if (!data_.texCoords.empty())
        corner.texCoord = valueIndex(texCoordIndex, at, vertex);
      if (!data_.colors.empty())
        corner.color = colorPerVertex ? valueIndex(colorIndex, at, vertex) : valueIndex(colorIndex, face, face);
      faces_.corners.push_back(corner);
    }
    if (faces_.corners.size() > (faces_.ends.empty() ? 0 : faces_.ends.back()))
      faces_.ends.push_back(faces_.corners.size());
    if (topology == Topology::lines)
      breakIntoLines(faces_);
  }

  /// The runs of vertices: those of `index`, separated by -1, or consecutive vertices by the counts of `countField`.
  std::vector<std::vector<std::uint32_t>> runs(const char* countField) const {
    std::vector<std::vector<std::uint32_t>> runs;
    if (node_.attribute("index") || std::string_view(node_.name()).starts_with("Indexed")) {
      runs.emplace_back();
      for (const std::int32_t vertex : integers("index"))
        if (vertex < 0)
          runs.emplace_back();
        else
          runs.back().push_back(static_cast<std::uint32_t>(vertex));
      return runs;
    }
    std::uint64_t next = 0;
    for (const std::int32_t count : integers(countField)) {
      if (count < 0 || next + static_cast<std::uint64_t>(count) > data_.positions.size())
        source_.fail(node_, ErrorKind::malformed, fmt::format("{} counts more vertices than there are", countField));
      runs.emplace_back();
      for (std::int32_t i = 0; i < count; ++i)
        runs.back().push_back(static_cast<std::uint32_t>(next++));
    }
    return runs;
  }

  /// All vertices, or those of `index`.
  std::vector<std::uint32_t> vertexSequence() const {
    std::vector<std::uint32_t> vertices;
    if (std::string_view(node_.name()).starts_with("Indexed")) {
      for (const std::int32_t vertex : integers("index"))
        if (vertex >= 0) // some programs separate faces by -1
          vertices.push_back(static_cast<std::uint32_t>(vertex));
    } else {
      for (std::uint32_t i = 0; i < data_.positions.size(); ++i)
        vertices.push_back(i);
    }
    return vertices;
  }

  void readTriangles() {
    const std::vector<std::uint32_t> vertices = vertexSequence();
    for (std::size_t i = 0; i + 2 < vertices.size(); i += 3)
      addFace({vertices[i], vertices[i + 1], vertices[i + 2]});
    addVertexAttributes(source_, node_, data_, faces_);
  }

  void readQuads() {
    const std::vector<std::uint32_t> vertices = vertexSequence();
    for (std::size_t i = 0; i + 3 < vertices.size(); i += 4)
      addFace({vertices[i], vertices[i + 1], vertices[i + 2], vertices[i + 3]});
    addVertexAttributes(source_, node_, data_, faces_);
  }

  void readStrips() {
    for (const std::vector<std::uint32_t>& run : runs("stripCount"))
      for (std::size_t i = 0; i + 2 < run.size(); ++i)
        addFace({run[i], run[i + 1 + i % 2], run[i + 2 - i % 2]});
    addVertexAttributes(source_, node_, data_, faces_);
  }

  void readFans() {
    for (const std::vector<std::uint32_t>& run : runs("fanCount"))
      for (std::size_t i = 1; i + 1 < run.size(); ++i)
        addFace({run[0], run[i], run[i + 1]});
    addVertexAttributes(source_, node_, data_, faces_);
  }

  void readLines() {
    for (const std::vector<std::uint32_t>& run : runs("vertexCount")) {
      for (const std::uint32_t vertex : run)
        faces_.corners.push_back({vertex, none, none, none});
      faces_.ends.push_back(faces_.corners.size());
    }
    addVertexAttributes(source_, node_, data_, faces_);
    breakIntoLines(faces_);
  }

  void readPoints() {
    for (std::uint32_t i = 0; i < data_.positions.size(); ++i)
      addFace({i});
    addVertexAttributes(source_, node_, data_, faces_);
    faces_.topology = Topology::points;
  }

  /// Reads 2D points, which lie in the plane z = 0.
  void readPositions2D(const char* field) {
    data_ = {};
    const std::vector<double> numbers = tuplesOf(source_, node_, field, 2);
    for (std::size_t i = 0; i < numbers.size(); i += 2)
      data_.positions.push_back(Vec3f(Vec3d{numbers[i], numbers[i + 1], 0}));
  }

  void readTriangles2D() {
    readPositions2D("vertices");
    readTriangles();
    data_.normals = {{0, 0, 1}};
    for (Corner& corner : faces_.corners)
      corner.normal = 0;
  }

  void readPolyline2D() {
    readPositions2D("lineSegments");
    for (std::uint32_t i = 0; i < data_.positions.size(); ++i)
      faces_.corners.push_back({i, none, none, none});
    faces_.ends.push_back(faces_.corners.size());
    breakIntoLines(faces_);
  }

  void readPolypoint2D() {
    readPositions2D("point");
    readPoints();
  }

  const Source& source_;
  pugi::xml_node node_;
  VertexData& data_;
  Faces& faces_;
};

} // namespace

bool hasCornerRuns(std::string_view element) {
  return CornerReader::readers().contains(element);
}

void addCornerRuns(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces) {
  CornerReader(source, node, data, faces).read();
}

void addVertexAttributes(const Source& source, pugi::xml_node node, const VertexData& data, Faces& faces) {
  const bool normalPerVertex = source.boolean(node, "normalPerVertex", true),
             colorPerVertex = source.boolean(node, "colorPerVertex", true);
  std::size_t at = 0;
  for (std::uint32_t face = 0; face < faces.ends.size(); ++face)
    for (; at < faces.ends[face]; ++at) {
      Corner& corner = faces.corners[at];
      if (!data.normals.empty())
        corner.normal = normalPerVertex ? corner.position : face;
      if (!data.texCoords.empty())
        corner.texCoord = corner.position;
      if (!data.colors.empty())
        corner.color = colorPerVertex ? corner.position : face;
    }
}

} // namespace imgeo::x3d
