#include "import/x3d/node_faces.h"

#include "import/x3d/corner_runs.h"
#include "import/x3d/elevation_grid.h"
#include "import/x3d/extrusion.h"
#include "import/x3d/nurbs.h"
#include "import/x3d/sized_nodes.h"
#include "import/x3d/vertex_data_reader.h"

#include <fmt/format.h>
#include <utility>
#include <vector>

namespace imgeo::x3d {

namespace {

/// Maximum number of vertices of an extrusion, the product of the lengths of two fields.
constexpr std::size_t maxExtrusionVertices = std::size_t{1} << 22;

/// Replaces vectors by those of the first key of an interpolator, if it has keys.
void setFirstKey(std::vector<Vec3f>& vectors, const Interpolator& interpolator) {
  if (interpolator.keys.empty())
    return;
  const std::size_t count = interpolator.values.size() / interpolator.keys.size() / 3;
  vectors.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    vectors[i] = {interpolator.values[3 * i], interpolator.values[3 * i + 1], interpolator.values[3 * i + 2]};
}

/// Reads heights over a grid in x and z (13.3.4).
void readElevationGrid(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces) {
  const std::vector<double> heights = source.reals(node, "height");
  const double columnsField = source.real(node, "xDimension", 0), rowsField = source.real(node, "zDimension", 0);
  if (!(columnsField >= 0 && rowsField >= 0 && columnsField * rowsField <= static_cast<double>(heights.size())))
    source.fail(node, ErrorKind::malformed,
                fmt::format("has {} heights and needs {} x {}", heights.size(), columnsField, rowsField));
  const auto columns = static_cast<std::uint32_t>(columnsField), rows = static_cast<std::uint32_t>(rowsField);
  if (columns < 2 || rows < 2)
    return;
  addElevationGrid({columns, rows, source.real(node, "xSpacing", 1), source.real(node, "zSpacing", 1), heights}, data,
                   faces);
  addVertexAttributes(source, node, data, faces);
}

/// Reads the tuples of a field; keeps the default where the field is absent.
template <std::size_t size, typename Tuple>
void readTuples(const Source& source, pugi::xml_node node, const char* field, std::vector<Tuple>& values) {
  if (!node.attribute(field))
    return;
  const std::vector<double> numbers = tuplesOf(source, node, field, size);
  values.clear();
  for (std::size_t i = 0; i < numbers.size(); i += size)
    if constexpr (size == 2)
      values.push_back({numbers[i], numbers[i + 1]});
    else if constexpr (size == 3)
      values.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    else
      values.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  if (values.empty())
    source.fail(node, ErrorKind::malformed, fmt::format("{} is empty", field));
}

void readExtrusion(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces) {
  Extrusion extrusion;
  readTuples<2>(source, node, "crossSection", extrusion.crossSection);
  readTuples<3>(source, node, "spine", extrusion.spine);
  readTuples<2>(source, node, "scale", extrusion.scale);
  readTuples<4>(source, node, "orientation", extrusion.orientation);
  extrusion.beginCap = source.boolean(node, "beginCap", true);
  extrusion.endCap = source.boolean(node, "endCap", true);
  if (extrusion.spine.size() * extrusion.crossSection.size() > maxExtrusionVertices)
    source.fail(node, ErrorKind::unsupported, fmt::format("has more than {} vertices", maxExtrusionVertices));
  data = {};
  extrude(extrusion, data, faces);
}

/// Reads a NURBS node. Of swept surfaces, only corners of their curves become sharp edges: smooth parts of curves
/// turn by less than the crease angle from one segment to the next.
void readNurbs(const Source& source, pugi::xml_node node, NodeFaces& read) {
  read.data = {};
  read.nurbsError = addNurbs(source, node, read.data, read.faces);
  read.defaultCreaseAngle = 1;
}

} // namespace

bool becomesMesh(std::string_view element) {
  return hasCornerRuns(element) || hasOnlySizes(element) || isNurbs(element) || element == "ElevationGrid" ||
         element == "Extrusion";
}

std::optional<NodeFaces> readNodeFaces(const Source& source, pugi::xml_node node, const AttributeChoice& kept,
                                       const MovingVertices* moving) {
  const std::string_view element = node.name();
  if (!becomesMesh(element))
    return {};
  NodeFaces read;
  if (hasOnlySizes(element)) {
    if (addSizedNode(source, node, read.data, read.faces) == Topology::lines)
      breakIntoLines(read.faces);
    return read;
  }
  NodeVertexData vertices = readVertexData(source, node, kept);
  read.data = std::move(vertices.data);
  read.furtherTexCoords = vertices.furtherTexCoords;
  read.texCoordGenerator = std::move(vertices.texCoordGenerator);
  if (moving) {
    setFirstKey(read.data.positions, moving->coordinates);
    setFirstKey(read.data.normals, moving->normals);
  }
  read.hasCreaseAngle = true;
  if (element == "ElevationGrid") {
    readElevationGrid(source, node, read.data, read.faces);
  } else if (element == "Extrusion") {
    readExtrusion(source, node, read.data, read.faces);
  } else if (isNurbs(element)) {
    readNurbs(source, node, read);
  } else {
    addCornerRuns(source, node, read.data, read.faces);
    read.hasCreaseAngle = element == "IndexedFaceSet" || !source.boolean(node, "normalPerVertex", true);
  }
  return read;
}

} // namespace imgeo::x3d
