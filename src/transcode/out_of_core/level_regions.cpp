#include "transcode/out_of_core/level_regions.h"

#include "base/error.h"
#include "base/file.h"
#include "base/narrow.h"
#include "prepare/levels/group_triangles.h"
#include "prepare/normals.h"
#include "prepare/weld.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace imgeo {

namespace {

/// A vertex's normal, by its position in the source.
struct BorderNormal {
  Vec3f position, normal;
};

auto orderOf(const Vec3f& position) {
  return std::tuple(position.x, position.y, position.z);
}

std::vector<Vec3f> latticePoints(std::span<const Vec3f> positions, const Lattice* lattice) {
  if (!lattice)
    return {positions.begin(), positions.end()};
  std::vector<Vec3f> points;
  points.reserve(positions.size());
  for (const Vec3u& point : quantise(positions, *lattice))
    points.emplace_back(point);
  return points;
}

/// The triangles of a region and those that touch it, in the order of the source.
class RegionTriangles {
public:
  RegionTriangles(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region)
      : level_(level), region_(region), axes_(axesOf(level.frame)) {
    for (std::size_t task = 0; task < level.scatterTasks; ++task)
      appendScattered(records_, work.file(taskFile("scatter", level.level, task)), region);
  }

  std::size_t count() const { return records_.size() / level_.layout.recordFloats(); }
  const float* record(std::size_t triangle) const { return records_.data() + triangle * level_.layout.recordFloats(); }
  bool isGhost(std::size_t triangle) const { return tagOf(record(triangle)) & 1; }

  /// The region of a corner's point.
  std::uint32_t homeOf(const Vec3f& point) const { return level_.tree.regionOf(keyOfPoint(axes_, point)); }

  /// By corner of all triangles: the lattice point.
  std::vector<Vec3f> points() const { return latticePoints(positions(), level_.lattice); }

  std::vector<Vec3f> positions() const {
    std::vector<Vec3f> positions;
    positions.reserve(3 * count());
    for (std::size_t triangle = 0; triangle < count(); ++triangle)
      for (std::size_t i = 0; i < 3; ++i)
        positions.push_back(positionOf(record(triangle), i));
    return positions;
  }

  /// By corner: the sum of the normals of all triangles around its position, as far as these are here.
  std::vector<Vec3f> computedNormals() const {
    Mesh mesh;
    mesh.positions = positions();
    mesh.corners.resize(mesh.positions.size());
    std::iota(mesh.corners.begin(), mesh.corners.end(), 0u);
    mesh.wedgePositions = mesh.corners;
    weld(mesh);
    computeNormals(mesh, level_.weighting);
    return gather(mesh.normals, mesh.corners);
  }

  std::vector<float> takeOwnRecords() {
    const std::size_t size = level_.layout.recordFloats();
    std::size_t kept = 0;
    for (std::size_t triangle = 0; triangle < count(); ++triangle)
      if (!isGhost(triangle))
        std::copy_n(record(triangle), size, records_.data() + size * kept++);
    records_.resize(size * kept);
    return std::move(records_);
  }

private:
  const RegionedLevel& level_;
  std::uint32_t region_;
  std::array<FrameKey, 3> axes_;
  std::vector<float> records_;
};

/// Normals of vertices whose home is another region.
class NeighbourNormals {
public:
  NeighbourNormals(const WorkFolder& work, std::uint32_t level) : work_(work), level_(level) {}

  const Vec3f& at(std::uint32_t home, const Vec3f& position) {
    auto entry = byRegion_.find(home);
    if (entry == byRegion_.end()) {
      const std::string path = work_.file(taskFile("normals", level_, home));
      const Bytes bytes = readFile(path);
      entry = byRegion_.emplace(home, WorkReader(bytes, path).takeAll<BorderNormal>()).first;
    }
    const auto found = std::ranges::lower_bound(entry->second, orderOf(position), {},
                                                [](const BorderNormal& each) { return orderOf(each.position); });
    if (found == entry->second.end() || orderOf(found->position) != orderOf(position))
      throw Error(ErrorKind::malformed, work_.file(taskFile("normals", level_, home)),
                  "is no work file of this conversion; convert without --resume");
    return found->normal;
  }

private:
  const WorkFolder& work_;
  std::uint32_t level_;
  std::map<std::uint32_t, std::vector<BorderNormal>> byRegion_;
};

/// The points of a region that are fixed because other regions have them, ascending.
std::vector<Vec3f> fixedPointsOf(const RegionTriangles& triangles, const std::vector<Vec3f>& points,
                                 std::uint32_t region) {
  std::vector<Vec3f> fixed;
  for (std::size_t corner = 0; corner < points.size(); ++corner)
    if (triangles.isGhost(corner / 3) || triangles.homeOf(points[corner]) != region)
      fixed.push_back(points[corner]);
  std::ranges::sort(fixed, {}, orderOf);
  fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
  return fixed;
}

/// By corner of a region's own triangles: the normals, of which neighbours have computed some.
std::vector<Vec3f> ownNormals(const RegionTriangles& triangles, const std::vector<Vec3f>& points,
                              const RegionedLevel& level, const WorkFolder& work, std::uint32_t region) {
  const std::vector<Vec3f> all = triangles.computedNormals();
  NeighbourNormals neighbours(work, level.level);
  std::vector<Vec3f> normals;
  for (std::size_t corner = 0; corner < all.size(); ++corner) {
    if (triangles.isGhost(corner / 3))
      continue;
    const std::uint32_t home = triangles.homeOf(points[corner]);
    normals.push_back(home == region ? all[corner]
                                     : neighbours.at(home, positionOf(triangles.record(corner / 3), corner % 3)));
  }
  return normals;
}

/// A region's own triangles as a level of their own, and which of its positions are fixed.
struct LoadedRegion {
  LevelTriangles level;
  std::vector<bool> isFixed;
};

LoadedRegion loadRegion(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region) {
  LoadedRegion loaded;
  RegionTriangles triangles(level, work, region);
  std::vector<Vec3f> fixed, normals;
  {
    const std::vector<Vec3f> points = triangles.points();
    fixed = fixedPointsOf(triangles, points, region);
    if (level.computesNormals)
      normals = ownNormals(triangles, points, level, work, region);
  }
  Mesh& mesh = loaded.level.mesh;
  {
    const std::vector<float> own = triangles.takeOwnRecords();
    mesh = level.layout.meshOf(own);
    for (std::size_t at = 0; level.level > 0 && at < own.size(); at += level.layout.recordFloats())
      loaded.level.segments.push_back(tagOf(&own[at]) >> 1);
  }
  if (level.computesNormals)
    mesh.normals = std::move(normals);
  mesh.positions = latticePoints(mesh.positions, level.lattice);
  weld(mesh);
  for (const Vec3f& position : mesh.positions)
    loaded.isFixed.push_back(std::ranges::binary_search(fixed, orderOf(position), {}, orderOf));
  return loaded;
}

} // namespace

void Scatter::add(const Mesh& mesh, const std::vector<Vec3f>& points, std::size_t triangle, std::uint32_t child) {
  const auto pointOf = [&](std::size_t i) -> const Vec3f& {
    return points[mesh.wedgePositions[mesh.corners[3 * triangle + i]]];
  };
  result_.lengths.add(pointOf(0), pointOf(1), pointOf(2));
  const TriangleRegions regions(level_.tree, axes_, pointOf(0), pointOf(1), pointOf(2));
  level_.layout.append(result_.records[regions.triangle], tagOfTriangle(child, false), mesh, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t region = regions.corners[i];
    const bool isRepeated = std::find(regions.corners, regions.corners + i, region) != regions.corners + i;
    if (region != regions.triangle && !isRepeated)
      level_.layout.append(result_.records[region], tagOfTriangle(child, true), mesh, triangle);
  }
}

Bytes borderNormalsOf(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region) {
  const RegionTriangles triangles(level, work, region);
  const std::vector<Vec3f> normals = triangles.computedNormals(), points = triangles.points();
  std::vector<BorderNormal> border;
  for (std::size_t corner = 0; corner < normals.size(); ++corner)
    if (triangles.isGhost(corner / 3) && triangles.homeOf(points[corner]) == region)
      border.push_back({positionOf(triangles.record(corner / 3), corner % 3), normals[corner]});
  const auto keyOf = [](const BorderNormal& each) { return orderOf(each.position); };
  std::ranges::sort(border, {}, keyOf);
  border.erase(std::ranges::unique(border, {}, keyOf).begin(), border.end());
  WorkWriter out;
  out.addAll(std::span<const BorderNormal>(border));
  return std::move(out.bytes);
}

BuiltRegion buildRegion(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region, const LevelPlan& plan,
                        const LevelOptions& options, const GeometryDescription& geometry,
                        const EncodeOptions& encoding) {
  LoadedRegion loaded = loadRegion(level, work, region);
  std::vector<std::uint32_t> all(loaded.level.mesh.elementCount());
  std::iota(all.begin(), all.end(), 0u);
  const std::vector<std::vector<std::uint32_t>> groups =
      groupTriangles(loaded.level.mesh, {std::move(all)}, options.groupTriangles, level.frame);
  fixShared(loaded.isFixed, loaded.level.mesh, groups);

  RegionGroups result;
  result.rows.resize(groups.size());
  std::vector<Bytes> files(groups.size());
  BuiltGroups built =
      buildGroups(loaded.level, groups, loaded.isFixed, plan, options.ratio, [&](std::size_t i, GroupMesh mesh) {
        EncodedGroup encoded = encodeGroup(std::move(mesh), geometry, encoding);
        result.rows[i].file = groupFileOf(encoded);
        files[i] = std::move(encoded.bytes);
      });
  RecordLayout layout = level.layout;
  layout.normals |= level.computesNormals;
  std::vector<float> forms;
  for (std::uint32_t i = 0; i < built.forms.size(); ++i) {
    LevelTriangles form;
    appendForm(form, built.forms[i]->patch, i);
    built.forms[i].reset();
    result.formElements += form.mesh.elementCount();
    for (std::size_t triangle = 0; triangle < form.mesh.elementCount(); ++triangle)
      layout.append(forms, i, form.mesh, triangle);
  }
  for (std::size_t i = 0; i < groups.size(); ++i)
    result.rows[i].group = std::move(built.groups[i]);
  const auto* from = reinterpret_cast<const std::uint8_t*>(forms.data());
  return {writeRegionGroups(result, files), Bytes(from, from + forms.size() * sizeof(float))};
}

} // namespace imgeo
