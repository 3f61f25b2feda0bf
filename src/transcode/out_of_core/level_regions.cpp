#include "transcode/out_of_core/level_regions.h"

#include "base/narrow.h"
#include "prepare/levels/group_triangles.h"
#include "prepare/weld.h"
#include "transcode/out_of_core/region_triangles.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace imgeo {

namespace {

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

/// A region's own triangles as a level of their own, and which of its positions are fixed.
struct LoadedRegion {
  LevelTriangles level;
  std::vector<bool> isFixed;
};

/// The charts of triangles whose corners are the wedges of a mesh, which has lattice points and the source's charts.
void setNewCharts(Mesh& mesh, std::size_t set, const NewCharts& charts) {
  std::vector<Vec2f>& numbers = texCoordsOf(mesh, set);
  for (std::size_t first = 0; first < mesh.corners.size(); first += 3) {
    TexturedTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.points[i] = Vec3u(mesh.positions[first + i]);
      triangle.texCoords[i] = mesh.texCoords[first + i];
    }
    const auto chart = static_cast<float>(charts.chartOf(triangle));
    for (std::size_t i = 0; i < 3; ++i)
      numbers[first + i].x = chart;
  }
}

LoadedRegion loadRegion(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region,
                        const NewCharts* newCharts) {
  LoadedRegion loaded;
  RegionTriangles triangles(level, work, region);
  std::vector<Vec3f> fixed, normals;
  {
    const std::vector<Vec3f> points = triangles.points();
    fixed = fixedPointsOf(triangles, points, region);
    if (level.computesNormals)
      normals = triangles.ownNormals(points, work, region);
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
  if (level.chartSet && !newCharts)
    for (Vec2f& label : texCoordsOf(mesh, *level.chartSet))
      label.x = static_cast<float>(level.charts.at(std::bit_cast<std::uint32_t>(label.x)));
  mesh.positions = latticePoints(mesh.positions, level.lattice);
  if (level.chartSet && newCharts)
    setNewCharts(mesh, *level.chartSet, *newCharts);
  weld(mesh);
  for (const Vec3f& position : mesh.positions)
    loaded.isFixed.push_back(std::ranges::binary_search(fixed, orderOf(position), {}, orderOf));
  return loaded;
}

} // namespace

void Scatter::addPoint(const Mesh& mesh, const std::vector<Vec3f>& points, std::size_t element) {
  const Vec3f& point = points[mesh.wedgePositions[mesh.corners[element]]];
  level_.layout.append(result_.records[level_.tree.regionOf(keyOfPoint(axes_, point))], 0, mesh, element);
}

void Scatter::add(const Mesh& mesh, const std::vector<Vec3f>& points, std::size_t element, std::uint32_t child) {
  if (level_.layout.topology == Topology::points)
    return addPoint(mesh, points, element);
  const auto pointOf = [&](std::size_t i) -> const Vec3f& {
    return points[mesh.wedgePositions[mesh.corners[3 * element + i]]];
  };
  result_.lengths.add(pointOf(0), pointOf(1), pointOf(2));
  const TriangleRegions regions(level_.tree, axes_, pointOf(0), pointOf(1), pointOf(2));
  level_.layout.append(result_.records[regions.triangle], tagOfTriangle(child, false), mesh, element);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t region = regions.corners[i];
    const bool isRepeated = std::find(regions.corners, regions.corners + i, region) != regions.corners + i;
    if (region != regions.triangle && !isRepeated)
      level_.layout.append(result_.records[region], tagOfTriangle(child, true), mesh, element);
  }
}

BuiltRegion buildRegion(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region, const LevelPlan& plan,
                        const LevelOptions& options, const GeometryDescription& geometry, const EncodeOptions& encoding,
                        LevelImages* images) {
  LoadedRegion loaded = loadRegion(level, work, region, images ? images->newCharts() : nullptr);
  std::vector<std::uint32_t> all(loaded.level.mesh.elementCount());
  std::iota(all.begin(), all.end(), 0u);
  const std::vector<std::vector<std::uint32_t>> groups =
      groupTriangles(loaded.level.mesh, {std::move(all)}, options.groupTriangles, level.frame);
  fixShared(loaded.isFixed, loaded.level.mesh, groups);

  RegionGroups result;
  result.rows.resize(groups.size());
  std::vector<Bytes> files(groups.size()), chips(groups.size());
  BuiltGroups built =
      buildGroups(loaded.level, groups, loaded.isFixed, plan, options.ratio, [&](std::size_t i, GroupMesh mesh) {
        if (images) {
          ChipFile image = images->makeFile(mesh.patch, level.level);
          result.rows[i].chip = chipRowOf(image);
          chips[i] = std::move(image.bytes);
          if (chips[i].empty())
            return; // only counted
        }
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
  return {writeRegionGroups(result, files, chips), Bytes(from, from + forms.size() * sizeof(float))};
}

} // namespace imgeo
