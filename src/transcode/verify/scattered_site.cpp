#include "transcode/verify/scattered_site.h"

#include "base/error.h"
#include "containers/flat_normals.h"
#include "prepare/weld.h"
#include "transcode/out_of_core/region_triangles.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace imgeo {

namespace {

/// The triangles of a patch with three different vertices, or its points, as a mesh on the lattice whose wedges are the
/// vertices.
Mesh latticeMeshOf(IndexedPatch patch, Topology topology) {
  Mesh mesh;
  mesh.topology = topology;
  if (topology == Topology::points)
    mesh.corners = pointsOf(patch);
  else
    for (const Vec3u& t : trianglesOf(patch))
      if (t.x != t.y && t.y != t.z && t.z != t.x)
        mesh.corners.insert(mesh.corners.end(), {t.x, t.y, t.z});
  for (const Vec3u& position : patch.positions)
    mesh.positions.emplace_back(position);
  mesh.wedgePositions.resize(mesh.positions.size());
  std::iota(mesh.wedgePositions.begin(), mesh.wedgePositions.end(), 0u);
  static_cast<VertexAttributes&>(mesh) = std::move(static_cast<VertexAttributes&>(patch));
  return mesh;
}

} // namespace

ScatteredSite::ScatteredSite(const ContainerReader& reader, const GeometryDescription& geometry,
                             const RegionTree& regions, const VerifyWork& work)
    : reader_(reader), geometry_(geometry), work_(work), boxes_(geometry) {
  level_.level = 1; // whose work files have other names than the source's
  level_.tree = regions;
  level_.frame = frameOfLevel(0);
  first_ = reader.decode(geometry.patches.at(0), geometry);
  level_.layout = RecordLayout::of(latticeMeshOf(first_, geometry.levels->topology));
  divideIntoTasks();
  level_.scatterTasks = ends_.size();
  std::vector<Box3d> boxes(geometry.patches.size());
  work.forEach(ends_.size(), [&](std::size_t task) { scatter(task, boxes); });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    boxes_.add(boxes[i], geometry.patches[i].box);
}

void ScatteredSite::divideIntoTasks() {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < geometry_.patches.size(); ++i) {
    for (const Draw& draw : geometry_.patches[i].draws)
      count += imgeo::elementsOf(draw).of(geometry_.levels->topology);
    if (count >= work_.pieceTriangles() || i + 1 == geometry_.patches.size()) {
      ends_.push_back(i + 1);
      count = 0;
    }
  }
}

void ScatteredSite::scatter(std::size_t task, std::vector<Box3d>& boxes) {
  Scatter scatter(level_);
  for (std::size_t i = task == 0 ? 0 : ends_[task - 1]; i < ends_[task]; ++i) {
    IndexedPatch patch = reader_.decode(geometry_.patches[i], geometry_);
    boxes[i] = boxOf(patch, geometry_.lattice);
    if (geometry_.isFlat && geometry_.levels->topology == Topology::triangles)
      makeFlat(patch, geometry_.lattice);
    const Mesh mesh = latticeMeshOf(std::move(patch), geometry_.levels->topology);
    if (!RecordLayout::of(mesh).hasSameAttributes(level_.layout))
      throw Error(ErrorKind::malformed, geometry_.levels->url, "has groups with other attributes than others have");
    for (std::size_t element = 0; element < mesh.elementCount(); ++element)
      scatter.add(mesh, mesh.positions, element, 0);
  }
  work_.write(taskFile("scatter", level_.level, task), writeScattered(scatter.take()));
}

ElementList ScatteredSite::elementsOf(std::uint32_t region) const {
  Mesh mesh = level_.layout.meshOf(RegionTriangles(level_, work_.folder(), region).takeOwnRecords());
  if (mesh.topology == Topology::triangles)
    weld(mesh);
  std::vector<Vec3u> points;
  for (const Vec3f& position : mesh.positions)
    points.emplace_back(position);
  return imgeo::elementsOf(mesh, points, {.topology = mesh.topology, .keepsAll = true}); // as vertices had differed
}

} // namespace imgeo
