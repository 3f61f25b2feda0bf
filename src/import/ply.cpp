// PLY (Turk, "The PLY Polygon File Format", 1994) with the properties that
// Stanford's, Cyberware's, MeshLab's, Blender's and photogrammetry tools write.
#include "base/error.h"
#include "import/formats.h"
#include "import/ply_content.h"
#include "import/triangulate.h"
#include "import/unit_normal.h"
#include "import/warnings.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <vector>

namespace imgeo {

namespace {

struct Triangles {
  std::vector<std::uint32_t> places; ///< three a triangle, into PlyContent::indices
  std::size_t fans = 0;              ///< concave polygons too large to clip
};

/// Every polygon's triangles. Empty `sizes` (all are triangles) is the caller's case.
Triangles triangulateAll(const PlyContent& content) {
  Triangles result;
  std::vector<Vec3f> ring;
  std::vector<std::uint32_t> local;
  std::uint32_t first = 0;
  for (const std::uint32_t size : content.sizes) {
    ring.clear(), local.clear();
    for (std::uint32_t i = 0; i < size; ++i)
      ring.push_back(content.positions[content.indices[first + i]]);
    result.fans += !triangulate(ring, local);
    for (const std::uint32_t place : local)
      result.places.push_back(first + place);
    first += size;
  }
  return result;
}

template <typename T>
void spread(std::vector<T>& attribute, const std::vector<std::uint32_t>& wedgeVertices) {
  if (attribute.empty())
    return;
  std::vector<T> perWedge;
  perWedge.reserve(wedgeVertices.size());
  for (const std::uint32_t vertex : wedgeVertices)
    perWedge.push_back(attribute[vertex]);
  attribute = std::move(perWedge);
}

/// One wedge a vertex; with texture coordinates per corner, one wedge a corner.
Mesh meshOf(PlyContent& content, std::size_t& fans) {
  Mesh mesh;
  mesh.normals = std::move(content.normals);
  mesh.texCoords = std::move(content.texCoords);
  mesh.colors = std::move(content.colors);
  mesh.colorComponents = content.hasAlpha ? 4 : 3;

  // Exporters of point clouds often write an empty `face` element too.
  const bool isCloud = content.indices.empty() && content.facesTooSmall == 0;
  mesh.topology = isCloud ? Topology::points : Topology::triangles;
  const bool perCorner = !isCloud && !content.cornerTexCoords.empty();
  if (!content.sizes.empty()) {
    Triangles triangles = triangulateAll(content);
    fans = triangles.fans;
    mesh.corners = std::move(triangles.places);
    if (!perCorner)
      for (std::uint32_t& corner : mesh.corners)
        corner = content.indices[corner];
  } else if (perCorner) {
    mesh.corners.resize(content.indices.size());
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
      mesh.corners[i] = static_cast<std::uint32_t>(i);
  } else {
    mesh.corners = std::move(content.indices);
  }

  if (perCorner) {
    mesh.wedgePositions = std::move(content.indices);
    spread(mesh.normals, mesh.wedgePositions);
    spread(mesh.colors, mesh.wedgePositions);
    mesh.texCoords = std::move(content.cornerTexCoords);
  } else {
    mesh.wedgePositions.resize(content.positions.size());
    for (std::size_t i = 0; i < mesh.wedgePositions.size(); ++i)
      mesh.wedgePositions[i] = static_cast<std::uint32_t>(i);
    if (isCloud)
      mesh.corners = mesh.wedgePositions;
  }
  mesh.positions = std::move(content.positions);
  return mesh;
}

/// What was left out or changed; `content` has given its vectors away, not its counts.
void addWarnings(std::vector<std::string>& warnings, const PlyContent& content, const Box3d& box) {
  if (!content.ignored.empty())
    warnings.push_back(
        fmt::format("Not carried over from the PLY file: {}.", fmt::join(content.ignored, ", ")));
  if (content.trailingBytes > 0)
    warnings.push_back(fmt::format("{} behind the last element of the PLY file, which imgeo ignored.",
                                   counted(content.trailingBytes, "byte stands", "bytes stand")));
  warnOfColors(warnings, content.colorsClamped);
  warnOfSmallFaces(warnings, content.facesTooSmall);
  if (content.largestRounding > box.longestEdge() / 131072) // half a step of 16 bits
    warnings.push_back(
        fmt::format("Coordinates far from the origin were rounded to single precision, by up to {:.2g}.",
                    content.largestRounding));
}

} // namespace

bool looksLikePly(ByteSpan bytes) {
  const std::string_view text = asText(bytes).substr(0, 4);
  return text == "ply\n" || text == "ply\r" || text == "ply ";
}

Imported readPly(ByteSpan bytes, const std::string& name) {
  const PlyHeader header = readPlyHeader(bytes, name);
  PlyContent content = readPlyContent(bytes, header, name);
  if (content.indices.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::limit, name, "the polygons have more corners than 32-bit indices can name");

  Imported imported;
  imported.format = "PLY";
  std::size_t unusableNormals = 0, fans = 0;
  for (Vec3f& normal : content.normals)
    unusableNormals += !makeUnit(normal);
  Mesh mesh = meshOf(content, fans);
  addWarnings(imported.warnings, content, boxOf(mesh));
  warnOfNormals(imported.warnings, unusableNormals);
  warnOfFans(imported.warnings, fans);
  mesh.name = stemOf(name);
  addShape(imported.scene, std::move(mesh), "");
  return imported;
}

} // namespace imgeo
