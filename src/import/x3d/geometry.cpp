#include "import/x3d/geometry.h"

#include "import/x3d/elevation_grid.h"
#include "import/x3d/extrusion.h"
#include "import/x3d/faces.h"
#include "import/x3d/nurbs.h"
#include "import/x3d/sized_nodes.h"
#include "import/x3d/texture_coordinates.h"
#include "import/x3d/vertex_data_reader.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

namespace imgeo::x3d {

namespace {

using Indices = std::vector<std::int32_t>;

/// Maximum number of vertices of an extrusion, the product of the lengths of two fields.
constexpr std::size_t maxExtrusionVertices = std::size_t{1} << 22;

/// Reads the faces, lines or points of one geometry node and gives corners their attributes.
class GeometryReader {
public:
  GeometryReader(const Source& source, pugi::xml_node node, const AttributeChoice& kept, const MovingVertices* moving)
      : source_(source), node_(node), kept_(kept), moving_(moving) {}

  using Readers = std::map<std::string_view, void (GeometryReader::*)()>;
  static const Readers& readers() {
    static const Readers readers{{"IndexedFaceSet", &GeometryReader::readIndexedFaces},
                                 {"TriangleSet", &GeometryReader::readTriangles},
                                 {"TriangleStripSet", &GeometryReader::readStrips},
                                 {"TriangleFanSet", &GeometryReader::readFans},
                                 {"IndexedTriangleSet", &GeometryReader::readTriangles},
                                 {"IndexedTriangleStripSet", &GeometryReader::readStrips},
                                 {"IndexedTriangleFanSet", &GeometryReader::readFans},
                                 {"QuadSet", &GeometryReader::readQuads},
                                 {"IndexedQuadSet", &GeometryReader::readQuads},
                                 {"ElevationGrid", &GeometryReader::readElevationGrid},
                                 {"Extrusion", &GeometryReader::readExtrusion},
                                 {"IndexedLineSet", &GeometryReader::readIndexedLines},
                                 {"LineSet", &GeometryReader::readLines},
                                 {"PointSet", &GeometryReader::readPoints},
                                 {"TriangleSet2D", &GeometryReader::readTriangles2D},
                                 {"Polyline2D", &GeometryReader::readPolyline2D},
                                 {"Polypoint2D", &GeometryReader::readPolypoint2D},
                                 {"NurbsCurve", &GeometryReader::readNurbs},
                                 {"NurbsPatchSurface", &GeometryReader::readNurbs},
                                 {"NurbsTrimmedSurface", &GeometryReader::readNurbs},
                                 {"NurbsSweptSurface", &GeometryReader::readNurbs},
                                 {"NurbsSwungSurface", &GeometryReader::readNurbs}};
    return readers;
  }

  std::optional<Geometry> read() {
    if (hasOnlySizes(node_.name())) {
      if (addSizedNode(source_, node_, data_, faces_) == Topology::lines)
        breakIntoLines();
      return faces_.corners.empty() ? Geometry{} : finished();
    }
    const auto reader = readers().find(node_.name());
    if (reader == readers().end())
      return {};
    NodeVertexData read = readVertexData(source_, node_, kept_);
    data_ = std::move(read.data);
    if (moving_) {
      setFirstKey(data_.positions, moving_->coordinates);
      setFirstKey(data_.normals, moving_->normals);
    }
    furtherTexCoords_ = read.furtherTexCoords;
    texCoordGenerator_ = std::move(read.texCoordGenerator);
    (this->*reader->second)();
    return faces_.corners.empty() ? Geometry{} : finished();
  }

private:
  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const { source_.fail(node_, kind, message); }

  /// Replaces vectors by those of the first key of an interpolator, if it has keys.
  static void setFirstKey(std::vector<Vec3f>& vectors, const Interpolator& interpolator) {
    if (interpolator.keys.empty())
      return;
    const std::size_t count = interpolator.values.size() / interpolator.keys.size() / 3;
    vectors.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      vectors[i] = {interpolator.values[3 * i], interpolator.values[3 * i + 1], interpolator.values[3 * i + 2]};
  }

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
    hasCreaseAngle_ = topology == Topology::triangles;
    if (topology == Topology::lines)
      breakIntoLines();
  }

  /// Replaces polylines by single lines.
  void breakIntoLines() {
    Faces lines{Topology::lines, {}, {}};
    std::size_t begin = 0;
    for (const std::size_t end : faces_.ends) {
      for (std::size_t i = begin; i + 1 < end; ++i)
        lines.corners.insert(lines.corners.end(), {faces_.corners[i], faces_.corners[i + 1]});
      begin = end;
    }
    faces_ = std::move(lines);
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
        fail(ErrorKind::malformed, fmt::format("{} counts more vertices than there are", countField));
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
    addVertexAttributes();
  }

  void readQuads() {
    const std::vector<std::uint32_t> vertices = vertexSequence();
    for (std::size_t i = 0; i + 3 < vertices.size(); i += 4)
      addFace({vertices[i], vertices[i + 1], vertices[i + 2], vertices[i + 3]});
    addVertexAttributes();
  }

  void readStrips() {
    for (const std::vector<std::uint32_t>& run : runs("stripCount"))
      for (std::size_t i = 0; i + 2 < run.size(); ++i)
        addFace({run[i], run[i + 1 + i % 2], run[i + 2 - i % 2]});
    addVertexAttributes();
  }

  void readFans() {
    for (const std::vector<std::uint32_t>& run : runs("fanCount"))
      for (std::size_t i = 1; i + 1 < run.size(); ++i)
        addFace({run[0], run[i], run[i + 1]});
    addVertexAttributes();
  }

  void readLines() {
    for (const std::vector<std::uint32_t>& run : runs("vertexCount")) {
      for (const std::uint32_t vertex : run)
        faces_.corners.push_back({vertex, none, none, none});
      faces_.ends.push_back(faces_.corners.size());
    }
    addVertexAttributes();
    breakIntoLines();
  }

  void readPoints() {
    for (std::uint32_t i = 0; i < data_.positions.size(); ++i)
      addFace({i});
    addVertexAttributes();
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
    breakIntoLines();
  }

  void readPolypoint2D() {
    readPositions2D("point");
    readPoints();
  }

  /// Sets the attributes of nodes with one index per vertex, or one value per face.
  void addVertexAttributes() {
    const bool normalPerVertex = source_.boolean(node_, "normalPerVertex", true),
               colorPerVertex = source_.boolean(node_, "colorPerVertex", true);
    std::size_t at = 0;
    for (std::uint32_t face = 0; face < faces_.ends.size(); ++face)
      for (; at < faces_.ends[face]; ++at) {
        Corner& corner = faces_.corners[at];
        if (!data_.normals.empty())
          corner.normal = normalPerVertex ? corner.position : face;
        if (!data_.texCoords.empty())
          corner.texCoord = corner.position;
        if (!data_.colors.empty())
          corner.color = colorPerVertex ? corner.position : face;
      }
    hasCreaseAngle_ = !normalPerVertex;
  }

  /// Reads heights over a grid in x and z (13.3.4).
  void readElevationGrid() {
    const std::vector<double> heights = source_.reals(node_, "height");
    const double columnsField = source_.real(node_, "xDimension", 0), rowsField = source_.real(node_, "zDimension", 0);
    if (!(columnsField >= 0 && rowsField >= 0 && columnsField * rowsField <= static_cast<double>(heights.size())))
      fail(ErrorKind::malformed,
           fmt::format("has {} heights and needs {} x {}", heights.size(), columnsField, rowsField));
    const auto columns = static_cast<std::uint32_t>(columnsField), rows = static_cast<std::uint32_t>(rowsField);
    if (columns < 2 || rows < 2)
      return;
    addElevationGrid({columns, rows, source_.real(node_, "xSpacing", 1), source_.real(node_, "zSpacing", 1), heights},
                     data_, faces_);
    addVertexAttributes();
    hasCreaseAngle_ = true;
  }

  /// Reads the tuples of a field; keeps the default where the field is absent.
  template <std::size_t size, typename Tuple> void readTuples(const char* field, std::vector<Tuple>& values) const {
    if (!node_.attribute(field))
      return;
    const std::vector<double> numbers = tuplesOf(source_, node_, field, size);
    values.clear();
    for (std::size_t i = 0; i < numbers.size(); i += size)
      if constexpr (size == 2)
        values.push_back({numbers[i], numbers[i + 1]});
      else if constexpr (size == 3)
        values.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
      else
        values.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
    if (values.empty())
      fail(ErrorKind::malformed, fmt::format("{} is empty", field));
  }

  void readExtrusion() {
    Extrusion extrusion;
    readTuples<2>("crossSection", extrusion.crossSection);
    readTuples<3>("spine", extrusion.spine);
    readTuples<2>("scale", extrusion.scale);
    readTuples<4>("orientation", extrusion.orientation);
    extrusion.beginCap = source_.boolean(node_, "beginCap", true);
    extrusion.endCap = source_.boolean(node_, "endCap", true);
    if (extrusion.spine.size() * extrusion.crossSection.size() > maxExtrusionVertices)
      fail(ErrorKind::unsupported, fmt::format("has more than {} vertices", maxExtrusionVertices));
    data_ = {};
    extrude(extrusion, data_, faces_);
    hasCreaseAngle_ = true;
  }

  /// Reads a NURBS node. Of swept surfaces, only corners of their curves become sharp edges: smooth parts of curves
  /// turn by less than the crease angle from one segment to the next.
  void readNurbs() {
    data_ = {};
    nurbsError_ = addNurbs(source_, node_, data_, faces_);
    hasCreaseAngle_ = true;
    defaultCreaseAngle_ = 1;
  }

  void requireInRange() const {
    const auto require = [&](std::uint32_t index, std::size_t count, const char* what) {
      if (index >= count)
        fail(ErrorKind::malformed, index == none ? fmt::format("has corners without a {}", what)
                                                 : fmt::format("names {} {} of {}", what, index, count));
    };
    for (const Corner& corner : faces_.corners) {
      require(corner.position, data_.positions.size(), "position");
      if (!data_.normals.empty())
        require(corner.normal, data_.normals.size(), "normal");
      if (!data_.texCoords.empty())
        require(corner.texCoord, data_.texCoords.size(), "texture coordinate");
      for (const std::vector<Vec2f>& texCoords : data_.furtherTexCoords)
        require(corner.texCoord, texCoords.size(), "texture coordinate");
      if (!data_.colors.empty())
        require(corner.color, data_.colors.size(), "colour");
    }
  }

  Geometry finished() {
    requireInRange();
    const bool isSurface = faces_.topology == Topology::triangles;
    if (isSurface && !source_.boolean(node_, "ccw", true))
      reverseWinding();
    // Normals that are smooth everywhere are computed later (prepare/normals), without splitting wedges.
    const double creaseAngle = source_.real(node_, "creaseAngle", defaultCreaseAngle_);
    const bool hasCreases = isSurface && hasCreaseAngle_ && data_.normals.empty() && creaseAngle < std::numbers::pi;
    if (hasCreases && moving_)
      separateCorners();
    else if (hasCreases)
      addCreaseNormals(data_, faces_, std::max(creaseAngle, 0.0));
    if (isSurface && data_.texCoords.empty() && source_.isTextured(node_))
      addDefaultTexCoords(data_, faces_);
    if (texCoordGenerator_)
      addGeneratedTexCoords(texCoordGenerator_->mode, data_, faces_);
    Geometry geometry;
    geometry.solid = source_.boolean(node_, "solid", !std::string_view(node_.name()).ends_with("2D"));
    geometry.nurbsError = nurbsError_;
    geometry.furtherTexCoords = furtherTexCoords_;
    geometry.approximatedTexCoords = texCoordGenerator_ ? texCoordGenerator_->approximated : "";
    std::vector<Corner> wedges;
    geometry.mesh = meshOf(data_, faces_, geometry.fans, moving_ ? &wedges : nullptr);
    if (moving_)
      sortByPoint(geometry.mesh, wedges);
    for (const Corner& wedge : wedges) {
      geometry.points.push_back(wedge.position);
      geometry.normalNumbers.push_back(wedge.normal);
    }
    if (hasCreases && moving_)
      geometry.creaseAngle = std::max(creaseAngle, 0.0);
    return geometry;
  }

  /// Brings the wedges of a mesh into the order of the points: those of a grid may follow one another row by row.
  static void sortByPoint(Mesh& mesh, std::vector<Corner>& wedges) {
    std::vector<std::uint32_t> order(wedges.size()), newOf(wedges.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t wedge) { return wedges[wedge].position; });
    for (std::uint32_t i = 0; i < order.size(); ++i)
      newOf[order[i]] = i;
    static_cast<VertexAttributes&>(mesh) = gather(mesh, order);
    mesh.wedgePositions = gather(mesh.wedgePositions, order);
    mesh.corners = gather(newOf, mesh.corners);
    wedges = gather(wedges, order);
  }

  /// Gives each corner a normal of its own: which of them are equal changes from frame to frame.
  void separateCorners() {
    for (Corner& corner : faces_.corners) {
      corner.normal = static_cast<std::uint32_t>(data_.normals.size());
      data_.normals.push_back({0, 0, 1});
    }
  }

  void reverseWinding() {
    std::size_t begin = 0;
    for (const std::size_t end : faces_.ends) {
      std::reverse(faces_.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                   faces_.corners.begin() + static_cast<std::ptrdiff_t>(end));
      begin = end;
    }
  }

  const Source& source_;
  pugi::xml_node node_;
  const AttributeChoice& kept_;
  const MovingVertices* moving_;
  VertexData data_;
  Faces faces_;
  std::size_t furtherTexCoords_ = 0;
  std::optional<double> nurbsError_;
  double defaultCreaseAngle_ = 0; ///< radians
  std::optional<TexCoordGenerator> texCoordGenerator_;
  bool hasCreaseAngle_ = false; ///< the node has a creaseAngle field, or flat faces: an angle of 0
};

} // namespace

bool becomesMesh(std::string_view element) {
  return GeometryReader::readers().contains(element) || hasOnlySizes(element);
}

std::optional<Geometry> readGeometry(const Source& source, pugi::xml_node node, const AttributeChoice& kept,
                                     const MovingVertices* moving) {
  return GeometryReader(source, node, kept, moving).read();
}

} // namespace imgeo::x3d
