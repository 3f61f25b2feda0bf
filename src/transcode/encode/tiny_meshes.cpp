#include "transcode/encode/tiny_meshes.h"

#include "containers/encodings.h"
#include "containers/stored_coords.h"
#include "documents/geometry_element.h"
#include "transcode/encode/encode_report.h"
#include "transcode/options/resolve_options.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace imgeo {

namespace {

/// Vertices of a tiny mesh. Larger ones take more bytes than their description.
constexpr std::size_t maxVertices = 64;
/// Fewer meshes are described one by one.
constexpr std::size_t minMembers = 16;
/// The most bits of a coordinate that single precision, in which GPUs compute, holds exactly.
constexpr std::uint32_t maxTinyMeshBits = 24;
/// Meshes that are centred within this many times their extent from their origin share a box whatever their transform.
constexpr double nearOrigin = 2;

double stepOf(const Box3d& box, const ConvertOptions& options) {
  return latticeFor(box, positionBitsFor(box, options)).step;
}

/// The bits of a lattice over a box whose step is at most `step`.
std::uint32_t bitsFor(const Box3d& box, double step) {
  for (std::uint32_t bits = 8; bits <= maxTinyMeshBits; ++bits)
    if (latticeFor(box, bits).step <= step * (1 + 1e-9))
      return bits;
  return maxTinyMeshBits + 1;
}

bool isNearOrigin(const Box3d& box) {
  const Vec3d center = box.center();
  return std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)}) <= nearOrigin * box.longestEdge();
}

/// Minimum and maximum of each set of texture coordinates.
std::vector<float> texCoordExtents(const Mesh& mesh) {
  std::vector<float> extents;
  for (std::size_t set = 0; set < texCoordSetCount(mesh); ++set) {
    const auto [s0, s1] = std::ranges::minmax(texCoordsOf(mesh, set), {}, &Vec2f::x);
    const auto [t0, t1] = std::ranges::minmax(texCoordsOf(mesh, set), {}, &Vec2f::y);
    extents.insert(extents.end(), {s0.x, s1.x, t0.y, t1.y});
  }
  return extents;
}

Box3d unionOf(Box3d a, const Box3d& b) {
  a.add(b.min);
  a.add(b.max);
  return a;
}

} // namespace

bool isTiny(const Mesh& mesh, const ConvertOptions& options) {
  const double edge = boxOf(mesh).longestEdge();
  return mesh.topology == Topology::triangles && options.primitives == Primitives::triangles &&
         mesh.namedAttributes.empty() && mesh.wedgeCount() <= maxVertices && std::isfinite(edge) && edge > 0;
}

std::vector<std::size_t> transformsAbove(const SceneGraph& graph) {
  std::vector<std::size_t> transforms(graph.nodes.size());
  std::vector<bool> isKnown(graph.nodes.size());
  for (const std::size_t node : nodesInOrder(graph)) { // parents before children
    const bool isTransform = std::holds_alternative<Transform>(graph.nodes[node].content);
    for (const std::size_t child : graph.nodes[node].children)
      if (!isKnown[child]) {
        isKnown[child] = true;
        transforms[child] = isTransform ? node + 1 : transforms[node];
      }
  }
  return transforms;
}

void TinyMeshes::add(Mesh mesh, std::size_t geometryIndex, std::size_t group, std::size_t transform,
                     std::optional<std::size_t> storedMesh) {
  const Box3d box = boxOf(mesh);
  const double step = stepOf(box, options_);
  const Key key{group,
                isNearOrigin(box) ? std::numeric_limits<std::size_t>::max() : transform,
                std::ilogb(box.longestEdge()),
                mesh.wedgeCount(),
                mesh.corners.size(),
                texCoordExtents(mesh)};
  File& file = open_[key];
  if (!file.members.empty() &&
      (file.vertices + mesh.wedgeCount() > rowOf(*options_.encoding).sharing->maxFileVertices ||
       bitsFor(unionOf(file.box, box), std::min(file.step, step)) > maxTinyMeshBits))
    encode(std::exchange(file, {}));
  file.box = unionOf(file.box, box);
  file.step = file.members.empty() ? step : std::min(file.step, step);
  file.vertices += mesh.wedgeCount();
  file.members.push_back({storedMesh ? Mesh() : std::move(mesh), storedMesh, geometryIndex, group, addedCount_++});
}

void TinyMeshes::finish() {
  for (auto& [key, file] : open_)
    encode(std::move(file));
  open_.clear();
  std::ranges::sort(alone_, {}, &Member::order);
  for (Member& member : alone_)
    take(encodeMesh(takeMesh(member), options_, files_, done_), member.geometryIndex, member.group);
  alone_.clear();
}

Mesh TinyMeshes::takeMesh(Member& member) const {
  return member.storedMesh ? stored_->read(*member.storedMesh) : std::move(member.mesh);
}

void TinyMeshes::take(EncodedMesh encoded, std::size_t geometryIndex, std::size_t group) {
  addToReport(report_, encoded);
  if (encoded.small)
    patchFiles_.add(std::move(encoded.small), geometryIndex, group);
  document_.geometries[geometryIndex] = std::move(encoded.geometry);
}

void TinyMeshes::encode(File file) {
  const std::uint32_t bits = bitsFor(file.box, file.step);
  if (file.members.size() < minMembers || bits > maxTinyMeshBits) {
    std::ranges::move(file.members, std::back_inserter(alone_));
    return;
  }
  GeometryDescription fields;
  fields.encoding = *options_.encoding;
  fields.lattice = latticeFor(file.box, ElementType::uint32, bits);
  const Lattice lattice = latticeInDocuments(fields);

  // Members whose descriptions are equal share a node and a file.
  std::vector<std::vector<std::size_t>> alike;
  const std::size_t firstGroup = std::numeric_limits<std::size_t>::max() - nextFile_;
  for (Member& member : file.members) {
    EncodedMesh encoded = encodeMesh(takeMesh(member), lattice, options_, files_, done_);
    GeometryDescription& geometry = encoded.geometry;
    const Box3d box = geometry.box;
    geometry.isShared = true;
    geometry.box = geometry.patches[0].box = {};
    auto found = std::ranges::find_if(alike, [&](const std::vector<std::size_t>& members) {
      const GeometryDescription& other = document_.geometries[members[0]];
      GeometryDescription same = geometry;
      same.box = same.patches[0].box = other.box;
      return same == other;
    });
    if (found == alike.end())
      found = alike.insert(found, std::vector<std::size_t>{});
    const std::size_t group = firstGroup - static_cast<std::size_t>(found - alike.begin());
    found->push_back(member.geometryIndex);
    take(std::move(encoded), member.geometryIndex, group);
    GeometryDescription& first = document_.geometries[found->front()];
    first.box = first.patches[0].box = found->size() == 1 ? box : unionOf(first.box, box);
  }
  nextFile_ += alike.size();
  for (std::size_t i = 0; i < alike.size(); ++i) {
    for (const std::size_t member : alike[i]) {
      GeometryDescription& geometry = document_.geometries[member];
      geometry.box = geometry.patches[0].box = document_.geometries[alike[i][0]].box;
    }
    patchFiles_.close(firstGroup - i);
  }
}

} // namespace imgeo
