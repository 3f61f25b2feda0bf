#include "transcode/out_of_core/region_charts.h"

#include "base/disjoint_sets.h"
#include "base/narrow.h"
#include "prepare/weld.h"
#include "transcode/out_of_core/region_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

namespace imgeo {

namespace {

constexpr std::uint64_t bitsAByte = 8;

struct LabelPair {
  std::uint32_t low, high;
  auto operator<=>(const LabelPair&) const = default;
};

/// A corner of a triangle: where it is, on the surface and in the image.
struct MappedCorner {
  std::array<float, 5> at; ///< -0 is 0
  std::uint32_t label;
  auto operator<=>(const MappedCorner&) const = default;
};

/// Calls visit(chart, texCoords) for the triangles of a level.
template <typename Visit> void visitTriangles(const RegionedLevel& level, const WorkFolder& work, Visit visit) {
  const std::size_t size = level.layout.recordFloats();
  for (std::size_t task = 0; task < level.scatterTasks; ++task)
    visitScattered(work.file(level.file("scatter", task)), [&](std::span<const float> records) {
      for (std::size_t at = 0; at + size <= records.size(); at += size) {
        const float* record = &records[at];
        if (isGhostTag(tagOf(record)))
          continue;
        MappedTriangle texCoords;
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const float* texCoord = record + level.layout.texCoordOffset(corner, 0);
          texCoords[corner] = {texCoord[0], texCoord[1]};
        }
        visit(level.charts.at(level.firstLabels[task] + labelOf(level, record)), texCoords);
      }
    });
}

} // namespace

std::uint32_t labelCharts(Mesh& piece, std::size_t set) {
  Mesh mapped; // of positions and texture coordinates alone
  mapped.positions = piece.positions;
  mapped.wedgePositions = piece.wedgePositions;
  mapped.corners = piece.corners;
  mapped.texCoords = piece.texCoords;
  weld(mapped);
  std::vector<std::uint32_t> ofWedge;
  const std::uint32_t count = numberCharts(ofWedge, mapped);
  std::vector<Vec2f>& labels = texCoordsOf(piece, set);
  labels.assign(piece.wedgeCount(), {});
  for (std::size_t corner = 0; corner < piece.corners.size(); ++corner)
    labels[piece.corners[corner]].x = std::bit_cast<float>(ofWedge[mapped.corners[corner]]);
  return count;
}

std::uint32_t labelOf(const RegionedLevel& level, const float* record) {
  return std::bit_cast<std::uint32_t>(record[level.layout.texCoordOffset(0, *level.chartSet)]);
}

Bytes chartPairsOf(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region) {
  const RegionTriangles triangles(level, work, region);
  std::vector<MappedCorner> corners;
  corners.reserve(3 * triangles.count());
  for (std::size_t triangle = 0; triangle < triangles.count(); ++triangle) {
    const float* record = triangles.record(triangle);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3f position = positionOf(record, corner);
      const float* texCoord = record + level.layout.texCoordOffset(corner, 0);
      corners.push_back(
          {{position.x + 0.0f, position.y + 0.0f, position.z + 0.0f, texCoord[0] + 0.0f, texCoord[1] + 0.0f},
           labelOf(level, record)});
    }
  }
  std::ranges::sort(corners, [](const MappedCorner& a, const MappedCorner& b) {
    return std::tie(a.at, a.label) < std::tie(b.at, b.label);
  });
  std::vector<LabelPair> pairs;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (corners[i].at == corners[i - 1].at && corners[i].label != corners[i - 1].label)
      pairs.push_back({corners[i - 1].label, corners[i].label});
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  WorkWriter out;
  out.addAll(std::span<const LabelPair>(pairs));
  return std::move(out.bytes);
}

std::vector<std::uint32_t> joinCharts(std::uint32_t labelCount, const std::vector<std::string>& pairFiles) {
  DisjointSets sets(labelCount);
  for (const std::string& path : pairFiles) {
    const Bytes bytes = readFile(path);
    for (const LabelPair& pair : WorkReader(bytes, path).takeAll<LabelPair>())
      sets.merge(pair.low, pair.high);
  }
  std::vector<std::uint32_t> charts(labelCount);
  std::uint32_t count = 0;
  for (std::uint32_t label = 0; label < labelCount; ++label)
    charts[label] = sets.find(label) == label ? count++ : charts[sets.find(label)]; // sets have their first label
  return charts;
}

Bytes drawCharts(const RegionedLevel& level, const WorkFolder& work, RasterSize size) {
  const std::uint32_t count = level.charts.empty() ? 0 : *std::ranges::max_element(level.charts) + 1;
  ChartPainter painter(count, size.width, size.height);
  const auto add = [&](void (ChartPainter::*to)(std::uint32_t, const MappedTriangle&)) {
    visitTriangles(level, work,
                   [&](std::uint32_t chart, const MappedTriangle& triangle) { (painter.*to)(chart, triangle); });
  };
  add(&ChartPainter::addBounds);
  painter.begin();
  add(&ChartPainter::addInside);
  add(&ChartPainter::addTouched);
  WorkWriter out;
  addCharts(out, painter.take());
  return std::move(out.bytes);
}

void addCharts(WorkWriter& out, const std::vector<ChartMask>& masks) {
  out.add(std::uint64_t{masks.size()});
  for (const ChartMask& mask : masks) {
    out.add(mask.rect());
    const std::vector<bool>& bits = mask.bits();
    for (std::size_t first = 0; first < bits.size(); first += bitsAByte) {
      std::uint8_t byte = 0;
      for (std::size_t i = first; i < std::min(first + bitsAByte, bits.size()); ++i)
        byte = static_cast<std::uint8_t>(byte | (bits[i] ? 1u : 0u) << (i - first));
      out.bytes.push_back(byte);
    }
  }
}

std::vector<ChartMask> readCharts(const std::string& path) {
  const FileView view(path);
  WorkReader in(view.bytes(), path);
  return takeCharts(in);
}

std::vector<ChartMask> takeCharts(WorkReader& in) {
  std::vector<ChartMask> masks;
  for (auto count = in.take<std::uint64_t>(); count > 0; --count) {
    const auto rect = in.take<TexelRect>();
    const std::size_t size = std::size_t{rect.width} * rect.height;
    const ByteSpan bytes = in.takeBytes((size + bitsAByte - 1) / bitsAByte);
    std::vector<bool> bits(size);
    for (std::size_t i = 0; i < size; ++i)
      bits[i] = bytes[i / bitsAByte] >> (i % bitsAByte) & 1;
    masks.emplace_back(rect, std::move(bits));
  }
  return masks;
}

} // namespace imgeo
