#include "transcode/out_of_core/region_triangles.h"

#include "base/error.h"
#include "base/file.h"
#include "prepare/normals.h"
#include "prepare/weld.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>

namespace imgeo {

namespace {

/// The positions of a triangle in the source, from one of its corners on.
using CornerKey = std::array<Vec3f, 3>;

/// The normal of a corner.
struct BorderNormal {
  CornerKey corner;
  Vec3f normal;
};

/// Sorts corners by their position, then by the other two.
auto orderOf(const CornerKey& corner) {
  return std::tuple_cat(orderOf(corner[0]), orderOf(corner[1]), orderOf(corner[2]));
}

CornerKey cornerKeyOf(const float* record, std::size_t corner) {
  return {positionOf(record, corner), positionOf(record, (corner + 1) % 3), positionOf(record, (corner + 2) % 3)};
}

/// Normals of corners whose home is another region.
class NeighbourNormals {
public:
  NeighbourNormals(const WorkFolder& work, const RegionedLevel& level) : work_(work), level_(level) {}

  const Vec3f& at(std::uint32_t home, const CornerKey& corner) {
    auto entry = byRegion_.find(home);
    if (entry == byRegion_.end()) {
      const std::string path = work_.file(level_.file("normals", home));
      const Bytes bytes = readFile(path);
      entry = byRegion_.emplace(home, WorkReader(bytes, path).takeAll<BorderNormal>()).first;
    }
    const auto found = std::ranges::lower_bound(entry->second, orderOf(corner), {},
                                                [](const BorderNormal& each) { return orderOf(each.corner); });
    if (found == entry->second.end() || orderOf(found->corner) != orderOf(corner))
      throw Error(ErrorKind::malformed, work_.file(level_.file("normals", home)),
                  "is no work file of this conversion; convert without --resume");
    return found->normal;
  }

private:
  const WorkFolder& work_;
  const RegionedLevel& level_;
  std::map<std::uint32_t, std::vector<BorderNormal>> byRegion_;
};

} // namespace

std::vector<Vec3f> latticePoints(std::span<const Vec3f> positions, const Lattice* lattice) {
  if (!lattice)
    return {positions.begin(), positions.end()};
  std::vector<Vec3f> points;
  points.reserve(positions.size());
  for (const Vec3u& point : quantise(positions, *lattice))
    points.emplace_back(point);
  return points;
}

RegionTriangles::RegionTriangles(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region)
    : level_(level), axes_(axesOf(level.frame)) {
  for (std::size_t task = 0; task < level.scatterTasks; ++task) {
    const std::size_t before = records_.size();
    appendScattered(records_, work.file(level.file("scatter", task)), region);
    if (level.chartSet)
      addToLabels(before, level.firstLabels[task]);
  }
}

/// Labels of a piece become those of the source.
void RegionTriangles::addToLabels(std::size_t firstFloat, std::uint32_t firstLabel) {
  for (std::size_t at = firstFloat; at < records_.size(); at += level_.layout.recordFloats())
    for (std::size_t corner = 0; corner < 3; ++corner) {
      float& label = records_[at + level_.layout.texCoordOffset(corner, *level_.chartSet)];
      label = std::bit_cast<float>(std::bit_cast<std::uint32_t>(label) + firstLabel);
    }
}

std::vector<Vec3f> RegionTriangles::points() const {
  return latticePoints(positions(), level_.lattice);
}

std::vector<Vec3f> RegionTriangles::positions() const {
  std::vector<Vec3f> positions;
  positions.reserve(3 * count());
  for (std::size_t triangle = 0; triangle < count(); ++triangle)
    for (std::size_t i = 0; i < 3; ++i)
      positions.push_back(positionOf(record(triangle), i));
  return positions;
}

std::vector<Vec3f> RegionTriangles::computedNormals() const {
  Mesh mesh;
  mesh.positions = positions();
  mesh.corners.resize(mesh.positions.size());
  std::iota(mesh.corners.begin(), mesh.corners.end(), 0u);
  mesh.wedgePositions = mesh.corners;
  mesh.creaseDegrees = level_.creaseDegrees;
  weld(mesh);
  computeNormals(mesh, level_.weighting);
  return gather(mesh.normals, mesh.corners);
}

std::vector<Vec3f> RegionTriangles::ownNormals(const std::vector<Vec3f>& points, const WorkFolder& work,
                                               std::uint32_t region) const {
  const std::vector<Vec3f> all = computedNormals();
  NeighbourNormals neighbours(work, level_);
  std::vector<Vec3f> normals;
  for (std::size_t corner = 0; corner < all.size(); ++corner) {
    if (isGhost(corner / 3))
      continue;
    const std::uint32_t home = homeOf(points[corner]);
    normals.push_back(home == region ? all[corner] : neighbours.at(home, cornerKeyOf(record(corner / 3), corner % 3)));
  }
  return normals;
}

std::vector<float> RegionTriangles::takeOwnRecords() {
  const std::size_t size = level_.layout.recordFloats();
  std::size_t kept = 0;
  for (std::size_t triangle = 0; triangle < count(); ++triangle)
    if (!isGhost(triangle))
      std::copy_n(record(triangle), size, records_.data() + size * kept++);
  records_.resize(size * kept);
  return std::move(records_);
}

Bytes borderNormalsOf(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region) {
  const RegionTriangles triangles(level, work, region);
  const std::vector<Vec3f> normals = triangles.computedNormals(), points = triangles.points();
  std::vector<BorderNormal> border;
  for (std::size_t corner = 0; corner < normals.size(); ++corner)
    if (triangles.isGhost(corner / 3) && triangles.homeOf(points[corner]) == region)
      border.push_back({cornerKeyOf(triangles.record(corner / 3), corner % 3), normals[corner]});
  const auto keyOf = [](const BorderNormal& each) { return orderOf(each.corner); };
  std::ranges::sort(border, {}, keyOf);
  border.erase(std::ranges::unique(border, {}, keyOf).begin(), border.end());
  WorkWriter out;
  out.addAll(std::span<const BorderNormal>(border));
  return std::move(out.bytes);
}

} // namespace imgeo
