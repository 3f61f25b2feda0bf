#include "transcode/out_of_core/cloud_regions.h"

#include "prepare/weld.h"

#include <utility>

namespace imgeo {

namespace {

Bytes bytesOf(std::span<const float> records) {
  const auto* from = reinterpret_cast<const std::uint8_t*>(records.data());
  return {from, from + records.size_bytes()};
}

/// The points of a region, in the order of the source, of which those that are equal in all are one.
Mesh loadRegion(const RegionedCloud& cloud, const WorkFolder& work, std::uint32_t region) {
  std::vector<float> records;
  for (std::size_t task = 0; task < cloud.scatterTasks; ++task)
    appendScattered(records, work.file(taskFile("scatter", 0, task)), region);
  Mesh mesh = cloud.layout.meshOf(records);
  records = {};
  weld(mesh);
  return mesh;
}

} // namespace

Bytes scatterPoints(const RegionedCloud& cloud, const Mesh& piece) {
  const std::vector<Vec3u> points = quantise(piece.positions, *cloud.lattice);
  const auto axes = axesOf(GroupFrame::straight);
  ScatteredElements scattered{std::vector<std::vector<float>>(cloud.tree.regionCount()), {}, 0};
  for (std::size_t i = 0; i < piece.elementCount(); ++i) {
    const Vec3f point(points[piece.wedgePositions[piece.corners[i]]]);
    cloud.layout.append(scattered.records[cloud.tree.regionOf(keyOfPoint(axes, point))], 0, piece, i);
  }
  return writeScattered(scattered);
}

PointGroupSink
GroupEncoder::sink(std::function<void(std::uint32_t level, std::size_t group, const std::vector<Patch>&)> alsoTake) {
  return {[this](std::uint32_t, std::size_t groupCount) {
            levels_.push_back({std::vector<GroupRow>(groupCount), std::vector<Bytes>(groupCount)});
          },
          [this, alsoTake = std::move(alsoTake)](std::uint32_t level, std::size_t group, std::vector<Patch> segments) {
            alsoTake(level, group, segments);
            EncodedGroup encoded = encodePointGroup(std::move(segments), geometry_, encoding_);
            Level& to = levels_[level - firstLevel_];
            to.rows[group].file = groupFileOf(encoded);
            to.files[group] = std::move(encoded.bytes);
          }};
}

std::vector<Bytes> GroupEncoder::takeFiles(PointLevels levels) {
  std::vector<Bytes> files;
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    RegionGroups groups;
    groups.rows = std::move(levels_[level].rows);
    for (std::size_t i = 0; i < groups.rows.size(); ++i)
      groups.rows[i].group = std::move(levels[level][i]);
    files.push_back(writeRegionGroups(groups, levels_[level].files));
    levels_[level].files = {};
  }
  return files;
}

BuiltCloudRegion buildCloudRegion(const RegionedCloud& cloud, const WorkFolder& work, std::uint32_t region,
                                  const LevelOptions& options, const GeometryDescription& geometry,
                                  const EncodeOptions& encoding) {
  const Mesh mesh = loadRegion(cloud, work, region);
  const std::vector<Vec3u> points = quantise(mesh.positions, *cloud.lattice);
  const std::uint64_t wedgeCount = mesh.wedgeCount();
  const std::uint32_t height =
      cloud.tree.regionCount() == 1 ? regionHeight(std::span(&wedgeCount, 1), options.groupTriangles) : cloud.height;
  Mesh root;
  GroupEncoder encoder(geometry, encoding, 0);
  PointLevels levels =
      buildPointRegion(mesh, points, height, options,
                       encoder.sink([&](std::uint32_t level, std::size_t, const std::vector<Patch>& segments) {
                         for (std::size_t i = 0; level == height && i < segments.size(); ++i) // one group
                           appendPoints(root, segments[i]);
                       }));
  WorkWriter kept;
  kept.add(height);
  kept.addAll(std::span<const Vec3u>(points));
  return {encoder.takeFiles(std::move(levels)), recordsOf(cloud.layout, root), std::move(kept.bytes)};
}

CloudRegion::CloudRegion(ByteSpan bytes, const std::string& path) {
  WorkReader in(bytes, path);
  height = in.take<std::uint32_t>();
  points = in.takeAll<Vec3u>();
}

std::uint32_t readRegionHeight(const std::string& path) {
  const FileView view(path);
  return WorkReader(view.bytes(), path).take<std::uint32_t>();
}

void appendPoints(Mesh& mesh, const Patch& patch) {
  mesh.topology = Topology::points;
  const auto before = static_cast<std::uint32_t>(mesh.wedgeCount());
  if (before == 0)
    static_cast<VertexAttributes&>(mesh) = patch;
  else
    append(mesh, before, patch, patch.wedgeCount());
  for (std::uint32_t i = 0; i < patch.wedgeCount(); ++i) {
    mesh.positions.emplace_back(patch.positions[patch.wedgePositions[i]]);
    mesh.wedgePositions.push_back(before + i);
    mesh.corners.push_back(before + i);
  }
}

Bytes recordsOf(const RecordLayout& layout, const Mesh& mesh) {
  std::vector<float> records;
  records.reserve(mesh.elementCount() * layout.recordFloats());
  for (std::size_t i = 0; i < mesh.elementCount(); ++i)
    layout.append(records, 0, mesh, i);
  return bytesOf(records);
}

} // namespace imgeo
