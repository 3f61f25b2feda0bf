#include "import/x3d/faces.h"

#include "import/mesh/triangulate.h"
#include "import/mesh/unit_normal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>

namespace imgeo::x3d {

namespace {

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::uint32_t index : {corner.position, corner.normal, corner.texCoord, corner.color})
      hash = (hash ^ index) * 0x100000001b3;
    return hash ^ hash >> 32;
  }
};

class WedgeBuilder {
public:
  WedgeBuilder(const VertexData& data, Mesh& mesh, std::vector<Corner>* wedges)
      : data_(data), mesh_(mesh), wedgeCorners_(wedges), localPosition_(data.positions.size(), none) {
    for (const NamedAttribute& attribute : data.pointAttributes)
      mesh.namedAttributes.push_back({attribute.name, attribute.components, {}});
  }

  void addCorner(const Corner& corner) {
    const auto [wedge, isNew] = wedges_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.wedgePositions.size()));
    if (isNew)
      addWedge(corner);
    mesh_.corners.push_back(wedge->second);
  }

private:
  void addWedge(const Corner& corner) {
    std::uint32_t& local = localPosition_[corner.position];
    if (local == none) {
      local = static_cast<std::uint32_t>(mesh_.positions.size());
      mesh_.positions.push_back(data_.positions[corner.position]);
    }
    mesh_.wedgePositions.push_back(local);
    if (wedgeCorners_)
      wedgeCorners_->push_back(corner);
    if (corner.normal != none)
      mesh_.normals.push_back(data_.normals[corner.normal]);
    if (corner.texCoord != none)
      mesh_.texCoords.push_back(data_.texCoords[corner.texCoord]);
    for (std::size_t set = 1; set <= data_.furtherTexCoords.size(); ++set)
      texCoordsOf(mesh_, set).push_back(data_.furtherTexCoords[set - 1][corner.texCoord]);
    if (corner.color != none)
      mesh_.colors.push_back(data_.colors[corner.color]);
    for (std::size_t i = 0; i < data_.pointAttributes.size(); ++i) {
      const NamedAttribute& attribute = data_.pointAttributes[i];
      const std::size_t point = std::min<std::size_t>(corner.position, attribute.count() - 1);
      for (std::size_t c = 0; c < attribute.components; ++c)
        mesh_.namedAttributes[i].values.push_back(attribute.values[attribute.components * point + c]);
    }
  }

  const VertexData& data_;
  Mesh& mesh_;
  std::vector<Corner>* wedgeCorners_;
  std::vector<std::uint32_t> localPosition_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> wedges_;
};

/// Newell's normal, normalised; zero for a face without area. Positions count from the first corner: far from the
/// origin, products of coordinates themselves would have no digits left for the face.
Vec3d faceNormal(const VertexData& data, std::span<const Corner> face) {
  Vec3d sum;
  const Vec3d first = face.empty() ? Vec3d{} : Vec3d(data.positions[face[0].position]);
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
    sum = sum +
          cross(Vec3d(data.positions[face[i].position]) - first, Vec3d(data.positions[face[i + 1].position]) - first);
  const double size = length(sum);
  return size > 0 ? sum * (1 / size) : Vec3d{};
}

} // namespace

void breakIntoLines(Faces& faces) {
  Faces lines{Topology::lines, {}, {}};
  std::size_t begin = 0;
  for (const std::size_t end : faces.ends) {
    for (std::size_t i = begin; i + 1 < end; ++i)
      lines.corners.insert(lines.corners.end(), {faces.corners[i], faces.corners[i + 1]});
    begin = end;
  }
  faces = std::move(lines);
}

void addCreaseNormals(VertexData& data, Faces& faces, double creaseAngle) {
  const bool isSmooth = creaseAngle >= std::numbers::pi;
  std::vector<Vec3d> normals;
  std::vector<Vec3d> sums(data.positions.size());                // around each position
  std::vector<std::uint32_t> firstOf(data.positions.size() + 1); // faces around each position, as one list
  for (const Corner& corner : faces.corners)
    ++firstOf[corner.position + 1];
  for (std::size_t i = 1; i < firstOf.size(); ++i)
    firstOf[i] += firstOf[i - 1];
  std::vector<std::uint32_t> around(faces.corners.size()), next(firstOf.begin(), firstOf.end() - 1);
  std::size_t begin = 0;
  for (const std::size_t end : faces.ends) {
    const std::span<const Corner> face(faces.corners.data() + begin, end - begin);
    const Vec3d normal = faceNormal(data, face);
    for (const Corner& corner : face) {
      around[next[corner.position]++] = static_cast<std::uint32_t>(normals.size());
      sums[corner.position] += normal;
    }
    normals.push_back(normal);
    begin = end;
  }
  const double minCosine = std::cos(creaseAngle) - 1e-9;
  const auto sumAround = [&](std::uint32_t position, std::size_t face) {
    const std::span<const std::uint32_t> others(around.data() + firstOf[position],
                                                around.data() + firstOf[position + 1]);
    if (isSmooth)
      return sums[position];
    if (others.size() > maxComparedFaces)
      return normals[face];
    Vec3d sum;
    for (const std::uint32_t other : others)
      if (dot(normals[other], normals[face]) >= minCosine || other == face)
        sum += normals[other];
    return sum;
  };
  std::size_t corner = 0;
  for (std::size_t face = 0; face < faces.ends.size(); ++face)
    for (; corner < faces.ends[face]; ++corner) {
      Vec3f normal(sumAround(faces.corners[corner].position, face));
      makeUnit(normal);
      if (data.normals.empty() || data.normals.back() != normal)
        data.normals.push_back(normal);
      faces.corners[corner].normal = static_cast<std::uint32_t>(data.normals.size() - 1);
    }
}

Mesh meshOf(const VertexData& data, const Faces& faces, std::size_t& fans, std::vector<Corner>* wedges) {
  Mesh mesh;
  mesh.topology = faces.topology;
  mesh.colorComponents = data.colorComponents;
  mesh.texCoordMappings = data.texCoordMappings;
  WedgeBuilder builder(data, mesh, wedges);
  if (faces.topology != Topology::triangles) {
    for (const Corner& corner : faces.corners)
      builder.addCorner(corner);
    return mesh;
  }
  std::vector<Vec3f> ring;
  std::vector<std::uint32_t> triangles;
  std::size_t begin = 0;
  for (const std::size_t end : faces.ends) {
    const std::span<const Corner> face(faces.corners.data() + begin, end - begin);
    begin = end;
    if (face.size() < 3)
      continue;
    ring.clear(), triangles.clear();
    for (const Corner& corner : face)
      ring.push_back(data.positions[corner.position]);
    fans += !triangulate(ring, triangles);
    for (const std::uint32_t corner : triangles)
      builder.addCorner(face[corner]);
  }
  return mesh;
}

} // namespace imgeo::x3d
