// PLY (Turk, "The PLY Polygon File Format", 1994), with the properties that the tools of Stanford and Cyberware,
// MeshLab, Blender and photogrammetry tools write.
#include "import/ply/ply.h"
#include "base/error.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/far_origin.h"
#include "import/mesh/triangulate.h"
#include "import/mesh/unit_normal.h"
#include "import/ply/content.h"
#include "import/ply/textures.h"
#include "import/source_name.h"
#include "import/text/line_ends.h"
#include "import/warnings.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <vector>

namespace imgeo {

namespace {

struct Triangles {
  std::vector<std::uint32_t> indices;  ///< three per triangle, each an offset in PlyContent::indices
  std::vector<std::uint32_t> polygons; ///< of each triangle
  std::size_t fans = 0;                ///< number of concave polygons that were cut as fans: too large for ear clipping
};

/// Triangulates all polygons. `content.sizes` must not be empty.
Triangles triangulateAll(const PlyContent& content) {
  Triangles result;
  std::vector<Vec3f> ring;
  std::vector<std::uint32_t> local;
  std::uint32_t first = 0, polygon = 0;
  for (const std::uint32_t size : content.sizes) {
    ring.clear(), local.clear();
    for (std::uint32_t i = 0; i < size; ++i)
      ring.push_back(content.positions[content.indices[first + i]]);
    result.fans += !triangulate(ring, local);
    for (const std::uint32_t index : local)
      result.indices.push_back(first + index);
    result.polygons.insert(result.polygons.end(), local.size() / 3, polygon++);
    first += size;
  }
  return result;
}

/// Whether the file is a surface. Point clouds often have an empty `face` element.
bool hasFaces(const PlyContent& content) {
  return !content.indices.empty() || content.facesTooSmall > 0;
}

/// A mesh of the edges and of the vertices that they use.
Mesh edgesOf(const PlyContent& content) {
  constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
  Mesh mesh;
  mesh.topology = Topology::lines;
  std::vector<std::uint32_t> wedgeOf(content.positions.size(), unseen), vertices;
  for (const std::uint32_t vertex : content.edges) {
    if (wedgeOf[vertex] == unseen) {
      wedgeOf[vertex] = static_cast<std::uint32_t>(vertices.size());
      mesh.wedgePositions.push_back(wedgeOf[vertex]);
      vertices.push_back(vertex);
    }
    mesh.corners.push_back(wedgeOf[vertex]);
  }
  static_cast<VertexAttributes&>(mesh) = gather(content.attributes, vertices);
  mesh.positions = gather(content.positions, vertices);
  return mesh;
}

/// A mesh of the polygons or points, with one wedge per vertex or, if texture coordinates are stored per corner, one
/// wedge per corner. Moves the vertices out of `content`, and makes its textures those of triangles.
Mesh surfaceOrCloudOf(PlyContent& content, std::size_t& fans) {
  Mesh mesh;
  const bool isCloud = !hasFaces(content);
  mesh.topology = isCloud ? Topology::points : Topology::triangles;
  const bool perCorner = !isCloud && !content.cornerTexCoords.empty();
  if (!content.sizes.empty()) {
    Triangles triangles = triangulateAll(content);
    fans = triangles.fans;
    mesh.corners = std::move(triangles.indices);
    content.textures = gather(content.textures, triangles.polygons);
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
    static_cast<VertexAttributes&>(mesh) = gather(content.attributes, mesh.wedgePositions);
    mesh.texCoords = std::move(content.cornerTexCoords);
  } else {
    static_cast<VertexAttributes&>(mesh) = std::move(content.attributes);
    mesh.wedgePositions.resize(content.positions.size());
    for (std::size_t i = 0; i < mesh.wedgePositions.size(); ++i)
      mesh.wedgePositions[i] = static_cast<std::uint32_t>(i);
    if (isCloud)
      mesh.corners = mesh.wedgePositions;
  }
  mesh.positions = std::move(content.positions);
  mesh.creaseDegrees.reset();
  return mesh;
}

/// Adds warnings about content that was left out or changed. The vertices of `content` may have been moved out before.
void addWarnings(std::vector<std::string>& warnings, const PlyContent& content, const Box3d& box) {
  if (!content.ignored.empty())
    warnings.push_back(fmt::format("Not carried over from the PLY file: {}.", fmt::join(content.ignored, ", ")));
  warnOfTrailingPlyBytes(warnings, content.trailingBytes);
  warnOfColors(warnings, content.colorsClamped);
  warnOfSmallFaces(warnings, content.facesTooSmall);
  warnOfRounding(warnings, content.maxRounding, box.longestEdge());
}

} // namespace

bool isPly(ByteSpan bytes) {
  const std::string_view text = asText(bytes).substr(0, 4);
  return text == "ply\n" || text == "ply\r" || text == "ply ";
}

void warnOfTrailingPlyBytes(std::vector<std::string>& warnings, std::uint64_t bytes) {
  if (bytes > 0)
    warnings.push_back(fmt::format("{} behind the last element of the PLY file, which imgeo ignored.",
                                   counted(bytes, "byte stands", "bytes stand")));
}

namespace {

Imported read(ByteSpan bytes, const std::string& name, const ImportOptions& options, bool hasTextures) {
  const PlyHeader header = readPlyHeader(bytes, name);
  Bytes text;
  if (header.hasCarriageReturns && header.encoding == PlyEncoding::ascii) {
    text = withoutCarriageReturns(bytes);
    bytes = text;
  }
  PlyContent content = readPlyContent(bytes, header, name, options.attributes, options.origin);
  if (std::max(content.indices.size(), content.edges.size()) > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::limit, name, "the polygons or edges have more corners than 32-bit indices can name");

  Imported imported;
  imported.format = "PLY";
  imported.up = header.up;
  std::size_t unusableNormals = 0, fans = 0;
  for (Vec3f& normal : content.attributes.normals)
    unusableNormals += !makeUnit(normal);
  Box3d box;
  for (const Vec3f& position : content.positions)
    box.add(Vec3d(position));
  imported.attributes = content.namedAttributes;
  const bool isSurface = hasFaces(content), hasEdges = !content.edges.empty();
  if (hasTextures && header.textureFiles.empty() && !content.textures.empty())
    content.ignored.push_back("'texnumber' of 'face'");
  Mesh edges = hasEdges ? edgesOf(content) : Mesh{};
  if (isSurface || !hasEdges) {
    Mesh mesh = surfaceOrCloudOf(content, fans);
    mesh.name = stemOf(name);
    if (hasTextures && isSurface && !header.textureFiles.empty()) {
      if (content.textures.empty())
        content.textures.assign(mesh.elementCount(), 0);
      addTexturedShapes(imported, dividedByTexture(std::move(mesh), content.textures), header.textureFiles, options,
                        name);
    } else {
      addShape(imported.scene, std::move(mesh), "");
    }
  }
  if (hasEdges) {
    edges.name = stemOf(name);
    addShape(imported.scene, std::move(edges), isSurface ? "edges" : "");
  }
  setOrigin(imported, content.origin);
  addWarnings(imported.warnings, content, box);
  warnOfNormals(imported.warnings, unusableNormals);
  warnOfFans(imported.warnings, fans);
  return imported;
}

} // namespace

Imported readPly(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return read(bytes, name, options, true);
}

Imported readPlyWithoutTextures(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return read(bytes, name, options, false);
}

} // namespace imgeo
