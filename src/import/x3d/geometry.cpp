#include "import/x3d/geometry.h"

#include "import/x3d/node_faces.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo::x3d {

namespace {

void requireInRange(const Source& source, pugi::xml_node node, const VertexData& data, const Faces& faces) {
  const auto require = [&](std::uint32_t index, std::size_t count, const char* what) {
    if (index >= count)
      source.fail(node, ErrorKind::malformed,
                  index == none ? fmt::format("has corners without a {}", what)
                                : fmt::format("names {} {} of {}", what, index, count));
  };
  for (const Corner& corner : faces.corners) {
    require(corner.position, data.positions.size(), "position");
    if (!data.normals.empty())
      require(corner.normal, data.normals.size(), "normal");
    if (!data.texCoords.empty())
      require(corner.texCoord, data.texCoords.size(), "texture coordinate");
    for (const std::vector<Vec2f>& texCoords : data.furtherTexCoords)
      require(corner.texCoord, texCoords.size(), "texture coordinate");
    if (!data.colors.empty())
      require(corner.color, data.colors.size(), "colour");
  }
}

void reverseWinding(Faces& faces) {
  std::size_t begin = 0;
  for (const std::size_t end : faces.ends) {
    std::reverse(faces.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                 faces.corners.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
}

/// Gives each corner a normal of its own: which of them are equal changes from frame to frame.
void separateCorners(VertexData& data, Faces& faces) {
  for (Corner& corner : faces.corners) {
    corner.normal = static_cast<std::uint32_t>(data.normals.size());
    data.normals.push_back({0, 0, 1});
  }
}

/// Brings the wedges of a mesh into the order of the points: those of a grid may follow one another row by row.
void sortByPoint(Mesh& mesh, std::vector<Corner>& wedges) {
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

/// The mesh of a node with corners.
Geometry geometryOf(const Source& source, pugi::xml_node node, NodeFaces read, const MovingVertices* moving) {
  VertexData& data = read.data;
  Faces& faces = read.faces;
  requireInRange(source, node, data, faces);
  const bool isSurface = faces.topology == Topology::triangles;
  if (isSurface && !source.boolean(node, "ccw", true))
    reverseWinding(faces);
  // Normals that are smooth everywhere are computed later (prepare/normals), without splitting wedges.
  const double creaseAngle = source.real(node, "creaseAngle", read.defaultCreaseAngle);
  const bool hasCreases = isSurface && read.hasCreaseAngle && data.normals.empty() && creaseAngle < std::numbers::pi;
  if (hasCreases && moving)
    separateCorners(data, faces);
  else if (hasCreases)
    addCreaseNormals(data, faces, std::max(creaseAngle, 0.0));
  if (isSurface && data.texCoords.empty() && source.isTextured(node))
    addDefaultTexCoords(data, faces);
  if (read.texCoordGenerator)
    addGeneratedTexCoords(read.texCoordGenerator->mode, data, faces);
  Geometry geometry;
  geometry.solid = source.boolean(node, "solid", !std::string_view(node.name()).ends_with("2D"));
  geometry.nurbsError = read.nurbsError;
  geometry.furtherTexCoords = read.furtherTexCoords;
  geometry.approximatedTexCoords = read.texCoordGenerator ? read.texCoordGenerator->approximated : "";
  std::vector<Corner> wedges;
  geometry.mesh = meshOf(data, faces, geometry.fans, moving ? &wedges : nullptr);
  if (moving)
    sortByPoint(geometry.mesh, wedges);
  for (const Corner& wedge : wedges) {
    geometry.points.push_back(wedge.position);
    geometry.normalNumbers.push_back(wedge.normal);
  }
  if (hasCreases && moving)
    geometry.creaseAngle = std::max(creaseAngle, 0.0);
  return geometry;
}

} // namespace

std::optional<Geometry> readGeometry(const Source& source, pugi::xml_node node, const AttributeChoice& kept,
                                     const MovingVertices* moving) {
  std::optional<NodeFaces> read = readNodeFaces(source, node, kept, moving);
  if (!read)
    return {};
  return read->faces.corners.empty() ? Geometry{} : geometryOf(source, node, *std::move(read), moving);
}

} // namespace imgeo::x3d
